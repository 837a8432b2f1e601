; From route_search.cpp, SHA-256 e08451f2cfad5d696e064549166dc263c0cc7415e6d9d52bafa9c49217c41101, by tools/native.py. Do not edit.

%struct.Point = type { <16 x float>, <16 x float>, <16 x float> }
%struct.Motion = type { [17 x float], [17 x float], [136 x float], [136 x float] }
%struct.Frame = type { [9 x <16 x float>], [3 x <16 x float>] }
%struct.Joint = type { [9 x float], [3 x float], float }
%struct.Sphere = type { float, float, float, float }
%struct.Object = type { [9 x float], [3 x float], [3 x float], float, float, float }
%struct.LinkPair = type { i64, i64, i64, i64 }
%struct.Part = type { [3 x float], [3 x float], float, float }
%struct.PartPair = type { i64, i64 }
%struct.Point.4 = type { <8 x double>, <8 x double>, <8 x double> }
%struct.Motion.1 = type { [17 x double], [17 x double], [136 x double], [136 x double] }
%struct.Piece = type { double, double }
%struct.Frame.2 = type { [9 x <8 x double>], [3 x <8 x double>] }
%struct.Joint.3 = type { [9 x double], [3 x double], double }
%struct.Sphere.5 = type { double, double, double, double }
%struct.Object.6 = type { [9 x double], [3 x double], [3 x double], double, double, double }
%struct.Part.7 = type { [3 x double], [3 x double], double, double }
%struct.Tree = type { ptr, ptr, i64 }
%struct.Random = type { i64 }

define void @check_edges(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, i64 noundef %3, float noundef %4, float noundef %5, ptr nocapture noundef writeonly %6) {
  %8 = icmp sgt i64 %3, 0
  br i1 %8, label %10, label %9

9:
  ret void

10:
  %11 = phi i64 [ %19, %10 ], [ 0, %7 ]
  %12 = load i64, ptr %0, align 8
  %13 = mul nsw i64 %12, %11
  %14 = getelementptr inbounds float, ptr %1, i64 %13
  %15 = getelementptr inbounds float, ptr %2, i64 %13
  %16 = tail call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef %14, ptr noundef %15, float noundef %4, float noundef %5)
  %17 = zext i1 %16 to i8
  %18 = getelementptr inbounds i8, ptr %6, i64 %11
  store i8 %17, ptr %18, align 1
  %19 = add nuw nsw i64 %11, 1
  %20 = icmp eq i64 %19, %3
  br i1 %20, label %9, label %10
}

declare void @llvm.lifetime.start.p0(i64 immarg, ptr nocapture)

define internal fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr nocapture noundef nonnull readonly align 8 dereferenceable(136) %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, float noundef %3, float noundef %4) unnamed_addr {
  %6 = alloca [192 x %struct.Point], align 64
  %7 = alloca [2 x i64], align 16
  %8 = alloca [9 x <16 x float>], align 64
  %9 = alloca %struct.Motion, align 4
  %10 = alloca [16 x float], align 16
  %11 = alloca [17 x %struct.Frame], align 64
  call void @llvm.lifetime.start.p0(i64 1224, ptr nonnull %9)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %10)
  call void @llvm.memset.p0.i64(ptr noundef nonnull align 16 dereferenceable(64) %10, i8 0, i64 64, i1 false)
  %12 = load i64, ptr %0, align 8
  %13 = icmp slt i64 %12, 0
  br i1 %13, label %19, label %14

14:
  %15 = getelementptr inbounds i8, ptr %0, i64 112
  %16 = icmp eq i64 %12, 0
  %17 = getelementptr inbounds i8, ptr %9, i64 68
  %18 = load ptr, ptr %15, align 8
  br label %29

19:
  %20 = getelementptr inbounds i8, ptr %0, i64 16
  %21 = load i64, ptr %20, align 8
  %22 = icmp sgt i64 %21, 0
  br i1 %22, label %23, label %111

23:
  %24 = getelementptr inbounds i8, ptr %0, i64 120
  %25 = icmp sgt i64 %12, 0
  %26 = getelementptr inbounds i8, ptr %9, i64 136
  %27 = getelementptr inbounds i8, ptr %9, i64 680
  %28 = load ptr, ptr %24, align 8
  br label %70

29:
  %30 = phi i64 [ 0, %14 ], [ %68, %65 ]
  %31 = mul nuw nsw i64 %30, %12
  %32 = getelementptr inbounds float, ptr %18, i64 %31
  br i1 %16, label %33, label %35

33:
  %34 = getelementptr inbounds [17 x float], ptr %9, i64 0, i64 %30
  store float 0.000000e+00, ptr %34, align 4
  br label %65

35:
  %36 = phi i64 [ %47, %35 ], [ 0, %29 ]
  %37 = phi float [ %46, %35 ], [ 0.000000e+00, %29 ]
  %38 = getelementptr inbounds float, ptr %32, i64 %36
  %39 = load float, ptr %38, align 4
  %40 = getelementptr inbounds float, ptr %2, i64 %36
  %41 = load float, ptr %40, align 4
  %42 = fcmp contract olt float %41, 0.000000e+00
  %43 = fneg contract float %41
  %44 = select contract i1 %42, float %43, float %41
  %45 = fmul contract float %39, %44
  %46 = fadd contract float %37, %45
  %47 = add nuw nsw i64 %36, 1
  %48 = icmp eq i64 %47, %12
  br i1 %48, label %49, label %35

49:
  %50 = getelementptr inbounds [17 x float], ptr %9, i64 0, i64 %30
  store float %46, ptr %50, align 4
  br label %51

51:
  %52 = phi i64 [ %63, %51 ], [ 0, %49 ]
  %53 = phi float [ %62, %51 ], [ 0.000000e+00, %49 ]
  %54 = getelementptr inbounds float, ptr %32, i64 %52
  %55 = load float, ptr %54, align 4
  %56 = getelementptr inbounds float, ptr %10, i64 %52
  %57 = load float, ptr %56, align 4
  %58 = fcmp contract olt float %57, 0.000000e+00
  %59 = fneg contract float %57
  %60 = select contract i1 %58, float %59, float %57
  %61 = fmul contract float %55, %60
  %62 = fadd contract float %53, %61
  %63 = add nuw nsw i64 %52, 1
  %64 = icmp eq i64 %63, %12
  br i1 %64, label %65, label %51

65:
  %66 = phi float [ 0.000000e+00, %33 ], [ %62, %51 ]
  %67 = getelementptr inbounds [17 x float], ptr %17, i64 0, i64 %30
  store float %66, ptr %67, align 4
  %68 = add nuw i64 %30, 1
  %69 = icmp eq i64 %30, %12
  br i1 %69, label %19, label %29

70:
  %71 = phi i64 [ 0, %23 ], [ %109, %106 ]
  %72 = mul nsw i64 %71, %12
  %73 = getelementptr inbounds float, ptr %28, i64 %72
  br i1 %25, label %76, label %74

74:
  %75 = getelementptr inbounds [136 x float], ptr %26, i64 0, i64 %71
  store float 0.000000e+00, ptr %75, align 4
  br label %106

76:
  %77 = phi i64 [ %88, %76 ], [ 0, %70 ]
  %78 = phi float [ %87, %76 ], [ 0.000000e+00, %70 ]
  %79 = getelementptr inbounds float, ptr %73, i64 %77
  %80 = load float, ptr %79, align 4
  %81 = getelementptr inbounds float, ptr %2, i64 %77
  %82 = load float, ptr %81, align 4
  %83 = fcmp contract olt float %82, 0.000000e+00
  %84 = fneg contract float %82
  %85 = select contract i1 %83, float %84, float %82
  %86 = fmul contract float %80, %85
  %87 = fadd contract float %78, %86
  %88 = add nuw nsw i64 %77, 1
  %89 = icmp eq i64 %88, %12
  br i1 %89, label %90, label %76

90:
  %91 = getelementptr inbounds [136 x float], ptr %26, i64 0, i64 %71
  store float %87, ptr %91, align 4
  br label %92

92:
  %93 = phi i64 [ %104, %92 ], [ 0, %90 ]
  %94 = phi float [ %103, %92 ], [ 0.000000e+00, %90 ]
  %95 = getelementptr inbounds float, ptr %73, i64 %93
  %96 = load float, ptr %95, align 4
  %97 = getelementptr inbounds float, ptr %10, i64 %93
  %98 = load float, ptr %97, align 4
  %99 = fcmp contract olt float %98, 0.000000e+00
  %100 = fneg contract float %98
  %101 = select contract i1 %99, float %100, float %98
  %102 = fmul contract float %96, %101
  %103 = fadd contract float %94, %102
  %104 = add nuw nsw i64 %93, 1
  %105 = icmp eq i64 %104, %12
  br i1 %105, label %106, label %92

106:
  %107 = phi float [ 0.000000e+00, %74 ], [ %103, %92 ]
  %108 = getelementptr inbounds [136 x float], ptr %27, i64 0, i64 %71
  store float %107, ptr %108, align 4
  %109 = add nuw nsw i64 %71, 1
  %110 = icmp eq i64 %109, %21
  br i1 %110, label %111, label %70

111:
  br label %112

112:
  %113 = phi i64 [ %115, %112 ], [ 68, %111 ]
  %114 = getelementptr inbounds i8, ptr %9, i64 %113
  store float %4, ptr %114, align 4
  %115 = add nuw nsw i64 %113, 4
  %116 = icmp eq i64 %115, 136
  br i1 %116, label %148, label %112

117:
  br i1 %13, label %118, label %122

118:
  %119 = phi float [ 0.000000e+00, %117 ], [ %128, %122 ]
  br i1 %22, label %120, label %140

120:
  %121 = getelementptr inbounds i8, ptr %9, i64 136
  br label %131

122:
  %123 = phi i64 [ %129, %122 ], [ 0, %117 ]
  %124 = phi float [ %128, %122 ], [ 0.000000e+00, %117 ]
  %125 = getelementptr inbounds [17 x float], ptr %9, i64 0, i64 %123
  %126 = load float, ptr %125, align 4
  %127 = fcmp contract ogt float %126, %124
  %128 = select i1 %127, float %126, float %124
  %129 = add nuw i64 %123, 1
  %130 = icmp eq i64 %123, %12
  br i1 %130, label %118, label %122

131:
  %132 = phi i64 [ 0, %120 ], [ %138, %131 ]
  %133 = phi float [ %119, %120 ], [ %137, %131 ]
  %134 = getelementptr inbounds [136 x float], ptr %121, i64 0, i64 %132
  %135 = load float, ptr %134, align 4
  %136 = fcmp contract ogt float %135, %133
  %137 = select i1 %136, float %135, float %133
  %138 = add nuw nsw i64 %132, 1
  %139 = icmp eq i64 %138, %21
  br i1 %139, label %140, label %131

140:
  %141 = phi float [ %119, %118 ], [ %137, %131 ]
  %142 = fmul contract float %3, 1.600000e+01
  %143 = fdiv contract float %141, %142
  %144 = fptosi float %143 to i64
  %145 = add i64 %144, 1
  %146 = shl nsw i64 %145, 4
  %147 = sitofp i64 %146 to float
  br label %194

148:
  %149 = phi i64 [ %151, %148 ], [ 680, %112 ]
  %150 = getelementptr inbounds i8, ptr %9, i64 %149
  store float %4, ptr %150, align 4
  %151 = add nuw nsw i64 %149, 4
  %152 = icmp eq i64 %151, 1224
  br i1 %152, label %117, label %148

153:
  call void @llvm.lifetime.start.p0(i64 13056, ptr nonnull %11)
  %154 = icmp slt i64 %144, 0
  br i1 %154, label %1263, label %155

155:
  %156 = fdiv contract float 1.000000e+00, %147
  %157 = insertelement <16 x float> poison, float %156, i64 0
  %158 = shufflevector <16 x float> %157, <16 x float> poison, <16 x i32> zeroinitializer
  %159 = getelementptr inbounds i8, ptr %11, i64 576
  %160 = icmp sgt i64 %12, 0
  %161 = getelementptr inbounds i8, ptr %0, i64 24
  %162 = load ptr, ptr %161, align 8
  %163 = fmul contract <16 x float> %200, zeroinitializer
  %164 = icmp slt i64 %12, 1
  %165 = getelementptr inbounds i8, ptr %0, i64 48
  %166 = load ptr, ptr %165, align 8
  %167 = getelementptr inbounds i8, ptr %9, i64 68
  %168 = getelementptr inbounds i8, ptr %0, i64 8
  %169 = load i64, ptr %168, align 8
  %170 = icmp sgt i64 %169, 0
  %171 = getelementptr inbounds i8, ptr %0, i64 56
  %172 = load ptr, ptr %171, align 8
  %173 = getelementptr inbounds i8, ptr %0, i64 64
  %174 = load ptr, ptr %173, align 8
  %175 = getelementptr inbounds i8, ptr %0, i64 32
  %176 = load ptr, ptr %175, align 8
  %177 = getelementptr inbounds i8, ptr %0, i64 40
  %178 = load ptr, ptr %177, align 8
  %179 = getelementptr inbounds i8, ptr %0, i64 96
  %180 = load ptr, ptr %179, align 8
  %181 = getelementptr inbounds i8, ptr %0, i64 88
  %182 = load ptr, ptr %181, align 8
  %183 = getelementptr inbounds i8, ptr %9, i64 136
  %184 = getelementptr inbounds i8, ptr %9, i64 680
  %185 = getelementptr inbounds i8, ptr %0, i64 128
  %186 = load ptr, ptr %185, align 8
  %187 = getelementptr inbounds i8, ptr %7, i64 8
  %188 = getelementptr inbounds i8, ptr %0, i64 80
  %189 = load ptr, ptr %188, align 8
  %190 = getelementptr inbounds i8, ptr %0, i64 72
  %191 = load ptr, ptr %190, align 8
  %192 = getelementptr inbounds i8, ptr %0, i64 104
  %193 = load ptr, ptr %192, align 8
  br label %207

194:
  %195 = phi i64 [ 0, %140 ], [ %201, %194 ]
  %196 = phi <16 x float> [ undef, %140 ], [ %200, %194 ]
  %197 = mul nsw i64 %195, %145
  %198 = add nsw i64 %197, 1
  %199 = sitofp i64 %198 to float
  %200 = insertelement <16 x float> %196, float %199, i64 %195
  %201 = add nuw nsw i64 %195, 1
  %202 = icmp eq i64 %201, 16
  br i1 %202, label %153, label %194

203:
  %204 = add nuw i64 %209, 1
  %205 = icmp sge i64 %209, %144
  %206 = icmp eq i64 %209, %144
  br i1 %206, label %1263, label %207

207:
  %208 = phi i1 [ false, %155 ], [ %205, %203 ]
  %209 = phi i64 [ 0, %155 ], [ %204, %203 ]
  %210 = uitofp nneg i64 %209 to float
  %211 = insertelement <16 x float> poison, float %210, i64 0
  %212 = shufflevector <16 x float> %211, <16 x float> poison, <16 x i32> zeroinitializer
  %213 = fadd contract <16 x float> %200, %212
  %214 = fmul contract <16 x float> %158, %213
  %215 = fmul contract <16 x float> %214, zeroinitializer
  br label %216

216:
  %217 = phi i64 [ 0, %207 ], [ %225, %216 ]
  %218 = and i64 %217, 3
  %219 = icmp eq i64 %218, 0
  %220 = uitofp i1 %219 to float
  %221 = insertelement <16 x float> poison, float %220, i64 0
  %222 = shufflevector <16 x float> %221, <16 x float> poison, <16 x i32> zeroinitializer
  %223 = fadd contract <16 x float> %215, %222
  %224 = getelementptr inbounds [9 x <16 x float>], ptr %11, i64 0, i64 %217
  store <16 x float> %223, ptr %224, align 64
  %225 = add nuw nsw i64 %217, 1
  %226 = icmp eq i64 %225, 9
  br i1 %226, label %228, label %216

227:
  br i1 %160, label %233, label %758

228:
  %229 = phi i64 [ %231, %228 ], [ 0, %216 ]
  %230 = getelementptr inbounds [3 x <16 x float>], ptr %159, i64 0, i64 %229
  store <16 x float> %215, ptr %230, align 64
  %231 = add nuw nsw i64 %229, 1
  %232 = icmp eq i64 %231, 3
  br i1 %232, label %227, label %228

233:
  %234 = phi i64 [ %237, %429 ], [ 0, %227 ]
  %235 = getelementptr inbounds %struct.Joint, ptr %162, i64 %234
  %236 = getelementptr inbounds %struct.Frame, ptr %11, i64 %234
  %237 = add nuw nsw i64 %234, 1
  %238 = getelementptr inbounds float, ptr %1, i64 %234
  %239 = load float, ptr %238, align 4
  %240 = insertelement <16 x float> poison, float %239, i64 0
  %241 = getelementptr inbounds float, ptr %2, i64 %234
  %242 = load float, ptr %241, align 4
  %243 = insertelement <16 x float> poison, float %242, i64 0
  %244 = shufflevector <16 x float> %243, <16 x float> poison, <16 x i32> zeroinitializer
  %245 = fmul contract <16 x float> %214, %244
  %246 = getelementptr inbounds i8, ptr %235, i64 36
  %247 = load float, ptr %246, align 4
  %248 = getelementptr inbounds i8, ptr %235, i64 40
  %249 = load float, ptr %248, align 4
  %250 = getelementptr inbounds i8, ptr %235, i64 44
  %251 = load float, ptr %250, align 4
  %252 = getelementptr inbounds i8, ptr %236, i64 576
  %253 = load <16 x float>, ptr %252, align 64
  %254 = load <16 x float>, ptr %236, align 64
  %255 = insertelement <16 x float> poison, float %247, i64 0
  %256 = shufflevector <16 x float> %255, <16 x float> poison, <16 x i32> zeroinitializer
  %257 = fmul contract <16 x float> %256, %254
  %258 = getelementptr inbounds i8, ptr %236, i64 64
  %259 = load <16 x float>, ptr %258, align 64
  %260 = insertelement <16 x float> poison, float %249, i64 0
  %261 = shufflevector <16 x float> %260, <16 x float> poison, <16 x i32> zeroinitializer
  %262 = fmul contract <16 x float> %261, %259
  %263 = getelementptr inbounds i8, ptr %236, i64 128
  %264 = load <16 x float>, ptr %263, align 64
  %265 = insertelement <16 x float> poison, float %251, i64 0
  %266 = shufflevector <16 x float> %265, <16 x float> poison, <16 x i32> zeroinitializer
  %267 = fmul contract <16 x float> %266, %264
  %268 = getelementptr inbounds i8, ptr %236, i64 640
  %269 = load <16 x float>, ptr %268, align 64
  %270 = getelementptr inbounds i8, ptr %236, i64 192
  %271 = load <16 x float>, ptr %270, align 64
  %272 = fmul contract <16 x float> %256, %271
  %273 = getelementptr inbounds i8, ptr %236, i64 256
  %274 = load <16 x float>, ptr %273, align 64
  %275 = fmul contract <16 x float> %261, %274
  %276 = getelementptr inbounds i8, ptr %236, i64 320
  %277 = load <16 x float>, ptr %276, align 64
  %278 = fmul contract <16 x float> %266, %277
  %279 = getelementptr inbounds i8, ptr %236, i64 704
  %280 = load <16 x float>, ptr %279, align 64
  %281 = getelementptr inbounds i8, ptr %236, i64 384
  %282 = load <16 x float>, ptr %281, align 64
  %283 = fmul contract <16 x float> %256, %282
  %284 = getelementptr inbounds i8, ptr %236, i64 448
  %285 = load <16 x float>, ptr %284, align 64
  %286 = fmul contract <16 x float> %261, %285
  %287 = getelementptr inbounds i8, ptr %236, i64 512
  %288 = load <16 x float>, ptr %287, align 64
  %289 = fmul contract <16 x float> %266, %288
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %8)
  br label %290

290:
  %291 = phi i64 [ 0, %233 ], [ %321, %320 ]
  %292 = mul nuw nsw i64 %291, 3
  %293 = getelementptr inbounds [9 x <16 x float>], ptr %236, i64 0, i64 %292
  %294 = load <16 x float>, ptr %293, align 64
  %295 = add nuw nsw i64 %292, 1
  %296 = getelementptr inbounds [9 x <16 x float>], ptr %236, i64 0, i64 %295
  %297 = load <16 x float>, ptr %296, align 64
  %298 = add nuw nsw i64 %292, 2
  %299 = getelementptr inbounds [9 x <16 x float>], ptr %236, i64 0, i64 %298
  %300 = load <16 x float>, ptr %299, align 64
  br label %323

301:
  %302 = getelementptr inbounds %struct.Frame, ptr %11, i64 %237
  %303 = shufflevector <16 x float> %240, <16 x float> poison, <16 x i32> zeroinitializer
  %304 = fadd contract <16 x float> %303, %245
  %305 = fadd contract <16 x float> %253, %257
  %306 = fadd contract <16 x float> %305, %262
  %307 = fadd contract <16 x float> %306, %267
  %308 = fadd contract <16 x float> %269, %272
  %309 = fadd contract <16 x float> %308, %275
  %310 = fadd contract <16 x float> %309, %278
  %311 = fadd contract <16 x float> %280, %283
  %312 = fadd contract <16 x float> %311, %286
  %313 = fadd contract <16 x float> %312, %289
  %314 = getelementptr inbounds i8, ptr %302, i64 576
  store <16 x float> %307, ptr %314, align 64
  %315 = getelementptr inbounds i8, ptr %302, i64 640
  store <16 x float> %310, ptr %315, align 64
  %316 = getelementptr inbounds i8, ptr %302, i64 704
  store <16 x float> %313, ptr %316, align 64
  %317 = getelementptr inbounds i8, ptr %235, i64 48
  %318 = load float, ptr %317, align 4
  %319 = fcmp contract une float %318, 0.000000e+00
  br i1 %319, label %348, label %367

320:
  %321 = add nuw nsw i64 %291, 1
  %322 = icmp eq i64 %321, 3
  br i1 %322, label %301, label %290

323:
  %324 = phi i64 [ 0, %290 ], [ %346, %323 ]
  %325 = getelementptr inbounds [9 x float], ptr %235, i64 0, i64 %324
  %326 = load float, ptr %325, align 4
  %327 = insertelement <16 x float> poison, float %326, i64 0
  %328 = shufflevector <16 x float> %327, <16 x float> poison, <16 x i32> zeroinitializer
  %329 = fmul contract <16 x float> %294, %328
  %330 = add nuw nsw i64 %324, 3
  %331 = getelementptr inbounds [9 x float], ptr %235, i64 0, i64 %330
  %332 = load float, ptr %331, align 4
  %333 = insertelement <16 x float> poison, float %332, i64 0
  %334 = shufflevector <16 x float> %333, <16 x float> poison, <16 x i32> zeroinitializer
  %335 = fmul contract <16 x float> %297, %334
  %336 = fadd contract <16 x float> %329, %335
  %337 = add nuw nsw i64 %324, 6
  %338 = getelementptr inbounds [9 x float], ptr %235, i64 0, i64 %337
  %339 = load float, ptr %338, align 4
  %340 = insertelement <16 x float> poison, float %339, i64 0
  %341 = shufflevector <16 x float> %340, <16 x float> poison, <16 x i32> zeroinitializer
  %342 = fmul contract <16 x float> %300, %341
  %343 = fadd contract <16 x float> %336, %342
  %344 = add nuw nsw i64 %324, %292
  %345 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %344
  store <16 x float> %343, ptr %345, align 64
  %346 = add nuw nsw i64 %324, 1
  %347 = icmp eq i64 %346, 3
  br i1 %347, label %320, label %323

348:
  %349 = phi i64 [ %353, %348 ], [ 0, %301 ]
  %350 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %349
  %351 = load <16 x float>, ptr %350, align 64
  %352 = getelementptr inbounds [9 x <16 x float>], ptr %302, i64 0, i64 %349
  store <16 x float> %351, ptr %352, align 64
  %353 = add nuw nsw i64 %349, 1
  %354 = icmp eq i64 %353, 9
  br i1 %354, label %355, label %348

355:
  %356 = phi i64 [ %365, %355 ], [ 0, %348 ]
  %357 = mul nuw nsw i64 %356, 3
  %358 = add nuw nsw i64 %357, 2
  %359 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %358
  %360 = load <16 x float>, ptr %359, align 64
  %361 = fmul contract <16 x float> %304, %360
  %362 = getelementptr inbounds [3 x <16 x float>], ptr %314, i64 0, i64 %356
  %363 = load <16 x float>, ptr %362, align 64
  %364 = fadd contract <16 x float> %363, %361
  store <16 x float> %364, ptr %362, align 64
  %365 = add nuw nsw i64 %356, 1
  %366 = icmp eq i64 %365, 3
  br i1 %366, label %429, label %355

367:
  %368 = fmul contract <16 x float> %304, <float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000>
  %369 = fadd contract <16 x float> %368, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %370 = fadd contract <16 x float> %369, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %371 = fmul contract <16 x float> %370, <float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000>
  %372 = fsub contract <16 x float> %304, %371
  %373 = fmul contract <16 x float> %370, <float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000>
  %374 = fsub contract <16 x float> %372, %373
  %375 = fmul contract <16 x float> %370, <float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000>
  %376 = fsub contract <16 x float> %374, %375
  %377 = fmul contract <16 x float> %370, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %378 = fadd contract <16 x float> %377, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %379 = fadd contract <16 x float> %378, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %380 = fsub contract <16 x float> %377, %379
  %381 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %380)
  %382 = fmul contract <16 x float> %381, <float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00>
  %383 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %382
  %384 = fmul contract <16 x float> %376, %376
  %385 = fmul contract <16 x float> %376, %384
  %386 = fmul contract <16 x float> %384, <float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000>
  %387 = fadd contract <16 x float> %386, <float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000>
  %388 = fmul contract <16 x float> %384, %387
  %389 = fadd contract <16 x float> %388, <float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000>
  %390 = fmul contract <16 x float> %384, %389
  %391 = fadd contract <16 x float> %390, <float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000>
  %392 = fmul contract <16 x float> %385, %391
  %393 = fadd contract <16 x float> %376, %392
  %394 = fmul contract <16 x float> %383, %393
  %395 = fmul contract <16 x float> %384, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %396 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %395
  %397 = fmul contract <16 x float> %384, %384
  %398 = fmul contract <16 x float> %384, <float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000>
  %399 = fsub contract <16 x float> <float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000>, %398
  %400 = fmul contract <16 x float> %384, %399
  %401 = fadd contract <16 x float> %400, <float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000>
  %402 = fmul contract <16 x float> %384, %401
  %403 = fadd contract <16 x float> %402, <float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000>
  %404 = fmul contract <16 x float> %397, %403
  %405 = fadd contract <16 x float> %396, %404
  %406 = fmul contract <16 x float> %383, %405
  br label %407

407:
  %408 = phi i64 [ 0, %367 ], [ %427, %407 ]
  %409 = mul nuw nsw i64 %408, 3
  %410 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %409
  %411 = load <16 x float>, ptr %410, align 64
  %412 = fmul contract <16 x float> %406, %411
  %413 = add nuw nsw i64 %409, 1
  %414 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %413
  %415 = load <16 x float>, ptr %414, align 64
  %416 = fmul contract <16 x float> %394, %415
  %417 = fadd contract <16 x float> %412, %416
  %418 = getelementptr inbounds [9 x <16 x float>], ptr %302, i64 0, i64 %409
  store <16 x float> %417, ptr %418, align 64
  %419 = fmul contract <16 x float> %406, %415
  %420 = fmul contract <16 x float> %394, %411
  %421 = fsub contract <16 x float> %419, %420
  %422 = getelementptr inbounds [9 x <16 x float>], ptr %302, i64 0, i64 %413
  store <16 x float> %421, ptr %422, align 64
  %423 = add nuw nsw i64 %409, 2
  %424 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %423
  %425 = load <16 x float>, ptr %424, align 64
  %426 = getelementptr inbounds [9 x <16 x float>], ptr %302, i64 0, i64 %423
  store <16 x float> %425, ptr %426, align 64
  %427 = add nuw nsw i64 %408, 1
  %428 = icmp eq i64 %427, 3
  br i1 %428, label %429, label %407

429:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %8)
  %430 = icmp eq i64 %237, %12
  br i1 %430, label %431, label %233

431:
  br i1 %164, label %758, label %432

432:
  %433 = phi <16 x i32> [ %755, %754 ], [ zeroinitializer, %431 ]
  %434 = phi i64 [ %756, %754 ], [ 1, %431 ]
  %435 = getelementptr inbounds %struct.Sphere, ptr %166, i64 %434
  %436 = getelementptr inbounds i8, ptr %435, i64 12
  %437 = load float, ptr %436, align 4
  %438 = fcmp contract olt float %437, 0.000000e+00
  br i1 %438, label %754, label %439

439:
  %440 = getelementptr inbounds %struct.Frame, ptr %11, i64 %434
  %441 = load float, ptr %435, align 4
  %442 = getelementptr inbounds i8, ptr %435, i64 4
  %443 = load float, ptr %442, align 4
  %444 = getelementptr inbounds i8, ptr %435, i64 8
  %445 = load float, ptr %444, align 4
  %446 = getelementptr inbounds i8, ptr %440, i64 576
  %447 = load <16 x float>, ptr %446, align 64
  %448 = load <16 x float>, ptr %440, align 64
  %449 = insertelement <16 x float> poison, float %441, i64 0
  %450 = shufflevector <16 x float> %449, <16 x float> poison, <16 x i32> zeroinitializer
  %451 = fmul contract <16 x float> %450, %448
  %452 = fadd contract <16 x float> %447, %451
  %453 = getelementptr inbounds i8, ptr %440, i64 64
  %454 = load <16 x float>, ptr %453, align 64
  %455 = insertelement <16 x float> poison, float %443, i64 0
  %456 = shufflevector <16 x float> %455, <16 x float> poison, <16 x i32> zeroinitializer
  %457 = fmul contract <16 x float> %456, %454
  %458 = fadd contract <16 x float> %452, %457
  %459 = getelementptr inbounds i8, ptr %440, i64 128
  %460 = load <16 x float>, ptr %459, align 64
  %461 = insertelement <16 x float> poison, float %445, i64 0
  %462 = shufflevector <16 x float> %461, <16 x float> poison, <16 x i32> zeroinitializer
  %463 = fmul contract <16 x float> %462, %460
  %464 = fadd contract <16 x float> %458, %463
  %465 = getelementptr inbounds i8, ptr %440, i64 640
  %466 = load <16 x float>, ptr %465, align 64
  %467 = getelementptr inbounds i8, ptr %440, i64 192
  %468 = load <16 x float>, ptr %467, align 64
  %469 = fmul contract <16 x float> %450, %468
  %470 = fadd contract <16 x float> %466, %469
  %471 = getelementptr inbounds i8, ptr %440, i64 256
  %472 = load <16 x float>, ptr %471, align 64
  %473 = fmul contract <16 x float> %456, %472
  %474 = fadd contract <16 x float> %470, %473
  %475 = getelementptr inbounds i8, ptr %440, i64 320
  %476 = load <16 x float>, ptr %475, align 64
  %477 = fmul contract <16 x float> %462, %476
  %478 = fadd contract <16 x float> %474, %477
  %479 = getelementptr inbounds i8, ptr %440, i64 704
  %480 = load <16 x float>, ptr %479, align 64
  %481 = getelementptr inbounds i8, ptr %440, i64 384
  %482 = load <16 x float>, ptr %481, align 64
  %483 = fmul contract <16 x float> %450, %482
  %484 = fadd contract <16 x float> %480, %483
  %485 = getelementptr inbounds i8, ptr %440, i64 448
  %486 = load <16 x float>, ptr %485, align 64
  %487 = fmul contract <16 x float> %456, %486
  %488 = fadd contract <16 x float> %484, %487
  %489 = getelementptr inbounds i8, ptr %440, i64 512
  %490 = load <16 x float>, ptr %489, align 64
  %491 = fmul contract <16 x float> %462, %490
  %492 = fadd contract <16 x float> %488, %491
  %493 = getelementptr inbounds [17 x float], ptr %9, i64 0, i64 %434
  %494 = load float, ptr %493, align 4
  %495 = insertelement <16 x float> poison, float %494, i64 0
  %496 = shufflevector <16 x float> %495, <16 x float> poison, <16 x i32> zeroinitializer
  %497 = fmul contract <16 x float> %163, %496
  %498 = getelementptr inbounds [17 x float], ptr %167, i64 0, i64 %434
  %499 = load float, ptr %498, align 4
  %500 = insertelement <16 x float> poison, float %499, i64 0
  %501 = shufflevector <16 x float> %500, <16 x float> poison, <16 x i32> zeroinitializer
  %502 = fadd contract <16 x float> %497, %501
  br i1 %170, label %503, label %754

503:
  %504 = mul nuw nsw i64 %169, %434
  %505 = getelementptr float, ptr %174, i64 %504
  %506 = getelementptr inbounds i64, ptr %176, i64 %434
  %507 = getelementptr inbounds i8, ptr %506, i64 8
  br label %508

508:
  %509 = phi <16 x i32> [ %433, %503 ], [ %751, %750 ]
  %510 = phi i64 [ 0, %503 ], [ %752, %750 ]
  %511 = getelementptr inbounds %struct.Object, ptr %172, i64 %510
  %512 = getelementptr float, ptr %505, i64 %510
  %513 = load float, ptr %512, align 4
  %514 = getelementptr inbounds i8, ptr %511, i64 60
  %515 = load float, ptr %514, align 4
  %516 = fadd contract float %513, %515
  %517 = fcmp contract olt float %516, -1.000000e+08
  br i1 %517, label %750, label %518

518:
  %519 = fadd contract float %437, %516
  %520 = insertelement <16 x float> poison, float %519, i64 0
  %521 = shufflevector <16 x float> %520, <16 x float> poison, <16 x i32> zeroinitializer
  %522 = fadd contract <16 x float> %502, %521
  %523 = getelementptr inbounds i8, ptr %511, i64 36
  %524 = load float, ptr %523, align 4
  %525 = insertelement <16 x float> poison, float %524, i64 0
  %526 = shufflevector <16 x float> %525, <16 x float> poison, <16 x i32> zeroinitializer
  %527 = load float, ptr %511, align 4
  %528 = insertelement <16 x float> poison, float %527, i64 0
  %529 = shufflevector <16 x float> %528, <16 x float> poison, <16 x i32> zeroinitializer
  %530 = fmul contract <16 x float> %464, %529
  %531 = fadd contract <16 x float> %526, %530
  %532 = getelementptr inbounds i8, ptr %511, i64 4
  %533 = load float, ptr %532, align 4
  %534 = insertelement <16 x float> poison, float %533, i64 0
  %535 = shufflevector <16 x float> %534, <16 x float> poison, <16 x i32> zeroinitializer
  %536 = fmul contract <16 x float> %478, %535
  %537 = fadd contract <16 x float> %531, %536
  %538 = getelementptr inbounds i8, ptr %511, i64 8
  %539 = load float, ptr %538, align 4
  %540 = insertelement <16 x float> poison, float %539, i64 0
  %541 = shufflevector <16 x float> %540, <16 x float> poison, <16 x i32> zeroinitializer
  %542 = fmul contract <16 x float> %492, %541
  %543 = fadd contract <16 x float> %537, %542
  %544 = getelementptr inbounds i8, ptr %511, i64 40
  %545 = load float, ptr %544, align 4
  %546 = insertelement <16 x float> poison, float %545, i64 0
  %547 = shufflevector <16 x float> %546, <16 x float> poison, <16 x i32> zeroinitializer
  %548 = getelementptr inbounds i8, ptr %511, i64 12
  %549 = load float, ptr %548, align 4
  %550 = insertelement <16 x float> poison, float %549, i64 0
  %551 = shufflevector <16 x float> %550, <16 x float> poison, <16 x i32> zeroinitializer
  %552 = fmul contract <16 x float> %464, %551
  %553 = fadd contract <16 x float> %547, %552
  %554 = getelementptr inbounds i8, ptr %511, i64 16
  %555 = load float, ptr %554, align 4
  %556 = insertelement <16 x float> poison, float %555, i64 0
  %557 = shufflevector <16 x float> %556, <16 x float> poison, <16 x i32> zeroinitializer
  %558 = fmul contract <16 x float> %478, %557
  %559 = fadd contract <16 x float> %553, %558
  %560 = getelementptr inbounds i8, ptr %511, i64 20
  %561 = load float, ptr %560, align 4
  %562 = insertelement <16 x float> poison, float %561, i64 0
  %563 = shufflevector <16 x float> %562, <16 x float> poison, <16 x i32> zeroinitializer
  %564 = fmul contract <16 x float> %492, %563
  %565 = fadd contract <16 x float> %559, %564
  %566 = getelementptr inbounds i8, ptr %511, i64 44
  %567 = load float, ptr %566, align 4
  %568 = insertelement <16 x float> poison, float %567, i64 0
  %569 = shufflevector <16 x float> %568, <16 x float> poison, <16 x i32> zeroinitializer
  %570 = getelementptr inbounds i8, ptr %511, i64 24
  %571 = load float, ptr %570, align 4
  %572 = insertelement <16 x float> poison, float %571, i64 0
  %573 = shufflevector <16 x float> %572, <16 x float> poison, <16 x i32> zeroinitializer
  %574 = fmul contract <16 x float> %464, %573
  %575 = fadd contract <16 x float> %569, %574
  %576 = getelementptr inbounds i8, ptr %511, i64 28
  %577 = load float, ptr %576, align 4
  %578 = insertelement <16 x float> poison, float %577, i64 0
  %579 = shufflevector <16 x float> %578, <16 x float> poison, <16 x i32> zeroinitializer
  %580 = fmul contract <16 x float> %478, %579
  %581 = fadd contract <16 x float> %575, %580
  %582 = getelementptr inbounds i8, ptr %511, i64 32
  %583 = load float, ptr %582, align 4
  %584 = insertelement <16 x float> poison, float %583, i64 0
  %585 = shufflevector <16 x float> %584, <16 x float> poison, <16 x i32> zeroinitializer
  %586 = fmul contract <16 x float> %492, %585
  %587 = fadd contract <16 x float> %581, %586
  %588 = fmul contract <16 x float> %543, zeroinitializer
  %589 = getelementptr inbounds i8, ptr %511, i64 68
  %590 = load float, ptr %589, align 4
  %591 = fcmp contract une float %590, 0.000000e+00
  %592 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %587)
  %593 = select contract i1 %591, <16 x float> %587, <16 x float> %592
  %594 = getelementptr inbounds i8, ptr %511, i64 64
  %595 = load float, ptr %594, align 4
  %596 = fcmp contract une float %595, 0.000000e+00
  br i1 %596, label %597, label %602

597:
  %598 = fmul contract <16 x float> %543, %543
  %599 = fmul contract <16 x float> %565, %565
  %600 = fadd contract <16 x float> %598, %599
  %601 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %600)
  br label %604

602:
  %603 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %543)
  br label %604

604:
  %605 = phi contract <16 x float> [ %601, %597 ], [ %603, %602 ]
  %606 = getelementptr inbounds i8, ptr %511, i64 48
  %607 = load float, ptr %606, align 4
  %608 = insertelement <16 x float> poison, float %607, i64 0
  %609 = shufflevector <16 x float> %608, <16 x float> poison, <16 x i32> zeroinitializer
  %610 = fsub contract <16 x float> %605, %609
  %611 = fcmp contract ogt <16 x float> %610, %588
  %612 = select contract <16 x i1> %611, <16 x float> %610, <16 x float> %588
  %613 = getelementptr inbounds i8, ptr %511, i64 56
  %614 = load float, ptr %613, align 4
  %615 = insertelement <16 x float> poison, float %614, i64 0
  %616 = shufflevector <16 x float> %615, <16 x float> poison, <16 x i32> zeroinitializer
  %617 = fsub contract <16 x float> %593, %616
  %618 = fcmp contract ogt <16 x float> %617, %588
  %619 = select contract <16 x i1> %618, <16 x float> %617, <16 x float> %588
  %620 = fmul contract <16 x float> %612, %612
  %621 = fmul contract <16 x float> %619, %619
  %622 = fadd contract <16 x float> %620, %621
  br i1 %596, label %634, label %623

623:
  %624 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %565)
  %625 = getelementptr inbounds i8, ptr %511, i64 52
  %626 = load float, ptr %625, align 4
  %627 = insertelement <16 x float> poison, float %626, i64 0
  %628 = shufflevector <16 x float> %627, <16 x float> poison, <16 x i32> zeroinitializer
  %629 = fsub contract <16 x float> %624, %628
  %630 = fcmp contract ogt <16 x float> %629, %588
  %631 = select contract <16 x i1> %630, <16 x float> %629, <16 x float> %588
  %632 = fmul contract <16 x float> %631, %631
  %633 = fadd contract <16 x float> %622, %632
  br label %634

634:
  %635 = phi <16 x float> [ %633, %623 ], [ %622, %604 ]
  %636 = fmul contract <16 x float> %522, %522
  %637 = fcmp contract olt <16 x float> %635, %636
  %638 = bitcast <16 x i1> %637 to i16
  %639 = icmp eq i16 %638, 0
  br i1 %639, label %750, label %640

640:
  %641 = load i64, ptr %506, align 8
  %642 = load i64, ptr %507, align 8
  %643 = icmp slt i64 %641, %642
  br i1 %643, label %644, label %745

644:
  %645 = getelementptr inbounds i8, ptr %511, i64 52
  br label %649

646:
  %647 = add i64 %651, 1
  %648 = icmp eq i64 %647, %642
  br i1 %648, label %745, label %649

649:
  %650 = phi <16 x i32> [ %509, %644 ], [ %741, %646 ]
  %651 = phi i64 [ %641, %644 ], [ %647, %646 ]
  %652 = getelementptr inbounds %struct.Sphere, ptr %178, i64 %651
  %653 = getelementptr inbounds i8, ptr %652, i64 12
  %654 = load float, ptr %653, align 4
  %655 = fadd contract float %516, %654
  %656 = insertelement <16 x float> poison, float %655, i64 0
  %657 = shufflevector <16 x float> %656, <16 x float> poison, <16 x i32> zeroinitializer
  %658 = fadd contract <16 x float> %502, %657
  %659 = load float, ptr %652, align 4
  %660 = getelementptr inbounds i8, ptr %652, i64 4
  %661 = load float, ptr %660, align 4
  %662 = getelementptr inbounds i8, ptr %652, i64 8
  %663 = load float, ptr %662, align 4
  %664 = insertelement <16 x float> poison, float %659, i64 0
  %665 = shufflevector <16 x float> %664, <16 x float> poison, <16 x i32> zeroinitializer
  %666 = fmul contract <16 x float> %448, %665
  %667 = fadd contract <16 x float> %447, %666
  %668 = insertelement <16 x float> poison, float %661, i64 0
  %669 = shufflevector <16 x float> %668, <16 x float> poison, <16 x i32> zeroinitializer
  %670 = fmul contract <16 x float> %454, %669
  %671 = fadd contract <16 x float> %667, %670
  %672 = insertelement <16 x float> poison, float %663, i64 0
  %673 = shufflevector <16 x float> %672, <16 x float> poison, <16 x i32> zeroinitializer
  %674 = fmul contract <16 x float> %460, %673
  %675 = fadd contract <16 x float> %671, %674
  %676 = fmul contract <16 x float> %468, %665
  %677 = fadd contract <16 x float> %466, %676
  %678 = fmul contract <16 x float> %472, %669
  %679 = fadd contract <16 x float> %677, %678
  %680 = fmul contract <16 x float> %476, %673
  %681 = fadd contract <16 x float> %679, %680
  %682 = fmul contract <16 x float> %482, %665
  %683 = fadd contract <16 x float> %480, %682
  %684 = fmul contract <16 x float> %486, %669
  %685 = fadd contract <16 x float> %683, %684
  %686 = fmul contract <16 x float> %490, %673
  %687 = fadd contract <16 x float> %685, %686
  %688 = fmul contract <16 x float> %529, %675
  %689 = fadd contract <16 x float> %526, %688
  %690 = fmul contract <16 x float> %535, %681
  %691 = fadd contract <16 x float> %690, %689
  %692 = fmul contract <16 x float> %541, %687
  %693 = fadd contract <16 x float> %692, %691
  %694 = fmul contract <16 x float> %551, %675
  %695 = fadd contract <16 x float> %547, %694
  %696 = fmul contract <16 x float> %557, %681
  %697 = fadd contract <16 x float> %696, %695
  %698 = fmul contract <16 x float> %563, %687
  %699 = fadd contract <16 x float> %698, %697
  %700 = fmul contract <16 x float> %573, %675
  %701 = fadd contract <16 x float> %569, %700
  %702 = fmul contract <16 x float> %579, %681
  %703 = fadd contract <16 x float> %702, %701
  %704 = fmul contract <16 x float> %585, %687
  %705 = fadd contract <16 x float> %704, %703
  %706 = fmul contract <16 x float> %693, zeroinitializer
  %707 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %705)
  %708 = select contract i1 %591, <16 x float> %705, <16 x float> %707
  br i1 %596, label %709, label %714

709:
  %710 = fmul contract <16 x float> %693, %693
  %711 = fmul contract <16 x float> %699, %699
  %712 = fadd contract <16 x float> %710, %711
  %713 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %712)
  br label %716

714:
  %715 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %693)
  br label %716

716:
  %717 = phi contract <16 x float> [ %713, %709 ], [ %715, %714 ]
  %718 = fsub contract <16 x float> %717, %609
  %719 = fcmp contract ogt <16 x float> %718, %706
  %720 = select contract <16 x i1> %719, <16 x float> %718, <16 x float> %706
  %721 = fsub contract <16 x float> %708, %616
  %722 = fcmp contract ogt <16 x float> %721, %706
  %723 = select contract <16 x i1> %722, <16 x float> %721, <16 x float> %706
  %724 = fmul contract <16 x float> %720, %720
  %725 = fmul contract <16 x float> %723, %723
  %726 = fadd contract <16 x float> %725, %724
  br i1 %596, label %737, label %727

727:
  %728 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %699)
  %729 = load float, ptr %645, align 4
  %730 = insertelement <16 x float> poison, float %729, i64 0
  %731 = shufflevector <16 x float> %730, <16 x float> poison, <16 x i32> zeroinitializer
  %732 = fsub contract <16 x float> %728, %731
  %733 = fcmp contract ogt <16 x float> %732, %706
  %734 = select contract <16 x i1> %733, <16 x float> %732, <16 x float> %706
  %735 = fmul contract <16 x float> %734, %734
  %736 = fadd contract <16 x float> %726, %735
  br label %737

737:
  %738 = phi <16 x float> [ %736, %727 ], [ %726, %716 ]
  %739 = fmul contract <16 x float> %658, %658
  %740 = fcmp contract olt <16 x float> %738, %739
  %741 = select <16 x i1> %740, <16 x i32> <i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1>, <16 x i32> %650
  %742 = icmp ne <16 x i32> %741, zeroinitializer
  %743 = bitcast <16 x i1> %742 to i16
  %744 = icmp eq i16 %743, 0
  br i1 %744, label %646, label %1258

745:
  %746 = phi <16 x i32> [ %509, %640 ], [ %741, %646 ]
  %747 = icmp eq <16 x i32> %746, zeroinitializer
  %748 = bitcast <16 x i1> %747 to i16
  %749 = icmp eq i16 %748, 0
  br i1 %749, label %1258, label %750

750:
  %751 = phi <16 x i32> [ %746, %745 ], [ %509, %634 ], [ %509, %508 ]
  %752 = add nuw nsw i64 %510, 1
  %753 = icmp eq i64 %752, %169
  br i1 %753, label %754, label %508

754:
  %755 = phi <16 x i32> [ %433, %432 ], [ %433, %439 ], [ %751, %750 ]
  %756 = add nuw i64 %434, 1
  %757 = icmp eq i64 %434, %12
  br i1 %757, label %758, label %432

758:
  %759 = phi <16 x i32> [ zeroinitializer, %431 ], [ zeroinitializer, %227 ], [ %755, %754 ]
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %6)
  br i1 %22, label %760, label %1256

760:
  %761 = phi <16 x i32> [ %1251, %1250 ], [ %759, %758 ]
  %762 = phi i64 [ %1252, %1250 ], [ 0, %758 ]
  %763 = phi i64 [ %1253, %1250 ], [ 0, %758 ]
  %764 = getelementptr inbounds %struct.LinkPair, ptr %180, i64 %763
  %765 = load i64, ptr %764, align 8
  %766 = getelementptr inbounds %struct.Sphere, ptr %182, i64 %765
  %767 = getelementptr inbounds i8, ptr %764, i64 8
  %768 = load i64, ptr %767, align 8
  %769 = getelementptr inbounds %struct.Sphere, ptr %182, i64 %768
  %770 = getelementptr inbounds %struct.Frame, ptr %11, i64 %765
  %771 = getelementptr inbounds %struct.Frame, ptr %11, i64 %768
  %772 = getelementptr inbounds [136 x float], ptr %183, i64 0, i64 %763
  %773 = load float, ptr %772, align 4
  %774 = insertelement <16 x float> poison, float %773, i64 0
  %775 = shufflevector <16 x float> %774, <16 x float> poison, <16 x i32> zeroinitializer
  %776 = fmul contract <16 x float> %163, %775
  %777 = getelementptr inbounds [136 x float], ptr %184, i64 0, i64 %763
  %778 = load float, ptr %777, align 4
  %779 = getelementptr inbounds float, ptr %186, i64 %763
  %780 = load float, ptr %779, align 4
  %781 = fadd contract float %778, %780
  %782 = insertelement <16 x float> poison, float %781, i64 0
  %783 = shufflevector <16 x float> %782, <16 x float> poison, <16 x i32> zeroinitializer
  %784 = fadd contract <16 x float> %776, %783
  %785 = load float, ptr %769, align 4
  %786 = getelementptr inbounds i8, ptr %769, i64 4
  %787 = load float, ptr %786, align 4
  %788 = getelementptr inbounds i8, ptr %769, i64 8
  %789 = load float, ptr %788, align 4
  %790 = getelementptr inbounds i8, ptr %771, i64 576
  %791 = load <16 x float>, ptr %790, align 64
  %792 = load <16 x float>, ptr %771, align 64
  %793 = insertelement <16 x float> poison, float %785, i64 0
  %794 = shufflevector <16 x float> %793, <16 x float> poison, <16 x i32> zeroinitializer
  %795 = fmul contract <16 x float> %794, %792
  %796 = fadd contract <16 x float> %791, %795
  %797 = getelementptr inbounds i8, ptr %771, i64 64
  %798 = load <16 x float>, ptr %797, align 64
  %799 = insertelement <16 x float> poison, float %787, i64 0
  %800 = shufflevector <16 x float> %799, <16 x float> poison, <16 x i32> zeroinitializer
  %801 = fmul contract <16 x float> %800, %798
  %802 = fadd contract <16 x float> %796, %801
  %803 = getelementptr inbounds i8, ptr %771, i64 128
  %804 = load <16 x float>, ptr %803, align 64
  %805 = insertelement <16 x float> poison, float %789, i64 0
  %806 = shufflevector <16 x float> %805, <16 x float> poison, <16 x i32> zeroinitializer
  %807 = fmul contract <16 x float> %806, %804
  %808 = fadd contract <16 x float> %802, %807
  %809 = getelementptr inbounds i8, ptr %771, i64 640
  %810 = load <16 x float>, ptr %809, align 64
  %811 = getelementptr inbounds i8, ptr %771, i64 192
  %812 = load <16 x float>, ptr %811, align 64
  %813 = fmul contract <16 x float> %794, %812
  %814 = fadd contract <16 x float> %810, %813
  %815 = getelementptr inbounds i8, ptr %771, i64 256
  %816 = load <16 x float>, ptr %815, align 64
  %817 = fmul contract <16 x float> %800, %816
  %818 = fadd contract <16 x float> %814, %817
  %819 = getelementptr inbounds i8, ptr %771, i64 320
  %820 = load <16 x float>, ptr %819, align 64
  %821 = fmul contract <16 x float> %806, %820
  %822 = fadd contract <16 x float> %818, %821
  %823 = getelementptr inbounds i8, ptr %771, i64 704
  %824 = load <16 x float>, ptr %823, align 64
  %825 = getelementptr inbounds i8, ptr %771, i64 384
  %826 = load <16 x float>, ptr %825, align 64
  %827 = fmul contract <16 x float> %794, %826
  %828 = fadd contract <16 x float> %824, %827
  %829 = getelementptr inbounds i8, ptr %771, i64 448
  %830 = load <16 x float>, ptr %829, align 64
  %831 = fmul contract <16 x float> %800, %830
  %832 = fadd contract <16 x float> %828, %831
  %833 = getelementptr inbounds i8, ptr %771, i64 512
  %834 = load <16 x float>, ptr %833, align 64
  %835 = fmul contract <16 x float> %806, %834
  %836 = fadd contract <16 x float> %832, %835
  %837 = getelementptr inbounds i8, ptr %766, i64 12
  %838 = load float, ptr %837, align 4
  %839 = getelementptr inbounds i8, ptr %769, i64 12
  %840 = load float, ptr %839, align 4
  %841 = fadd contract float %838, %840
  %842 = insertelement <16 x float> poison, float %841, i64 0
  %843 = shufflevector <16 x float> %842, <16 x float> poison, <16 x i32> zeroinitializer
  %844 = fadd contract <16 x float> %784, %843
  %845 = load float, ptr %766, align 4
  %846 = getelementptr inbounds i8, ptr %766, i64 4
  %847 = load float, ptr %846, align 4
  %848 = getelementptr inbounds i8, ptr %766, i64 8
  %849 = load float, ptr %848, align 4
  %850 = getelementptr inbounds i8, ptr %770, i64 576
  %851 = load <16 x float>, ptr %850, align 64
  %852 = load <16 x float>, ptr %770, align 64
  %853 = insertelement <16 x float> poison, float %845, i64 0
  %854 = shufflevector <16 x float> %853, <16 x float> poison, <16 x i32> zeroinitializer
  %855 = fmul contract <16 x float> %854, %852
  %856 = fadd contract <16 x float> %851, %855
  %857 = getelementptr inbounds i8, ptr %770, i64 64
  %858 = load <16 x float>, ptr %857, align 64
  %859 = insertelement <16 x float> poison, float %847, i64 0
  %860 = shufflevector <16 x float> %859, <16 x float> poison, <16 x i32> zeroinitializer
  %861 = fmul contract <16 x float> %860, %858
  %862 = fadd contract <16 x float> %856, %861
  %863 = getelementptr inbounds i8, ptr %770, i64 128
  %864 = load <16 x float>, ptr %863, align 64
  %865 = insertelement <16 x float> poison, float %849, i64 0
  %866 = shufflevector <16 x float> %865, <16 x float> poison, <16 x i32> zeroinitializer
  %867 = fmul contract <16 x float> %866, %864
  %868 = fadd contract <16 x float> %862, %867
  %869 = getelementptr inbounds i8, ptr %770, i64 640
  %870 = load <16 x float>, ptr %869, align 64
  %871 = getelementptr inbounds i8, ptr %770, i64 192
  %872 = load <16 x float>, ptr %871, align 64
  %873 = fmul contract <16 x float> %854, %872
  %874 = fadd contract <16 x float> %870, %873
  %875 = getelementptr inbounds i8, ptr %770, i64 256
  %876 = load <16 x float>, ptr %875, align 64
  %877 = fmul contract <16 x float> %860, %876
  %878 = fadd contract <16 x float> %874, %877
  %879 = getelementptr inbounds i8, ptr %770, i64 320
  %880 = load <16 x float>, ptr %879, align 64
  %881 = fmul contract <16 x float> %866, %880
  %882 = fadd contract <16 x float> %878, %881
  %883 = getelementptr inbounds i8, ptr %770, i64 704
  %884 = load <16 x float>, ptr %883, align 64
  %885 = getelementptr inbounds i8, ptr %770, i64 384
  %886 = load <16 x float>, ptr %885, align 64
  %887 = fmul contract <16 x float> %854, %886
  %888 = fadd contract <16 x float> %884, %887
  %889 = getelementptr inbounds i8, ptr %770, i64 448
  %890 = load <16 x float>, ptr %889, align 64
  %891 = fmul contract <16 x float> %860, %890
  %892 = fadd contract <16 x float> %888, %891
  %893 = getelementptr inbounds i8, ptr %770, i64 512
  %894 = load <16 x float>, ptr %893, align 64
  %895 = fmul contract <16 x float> %866, %894
  %896 = fadd contract <16 x float> %892, %895
  %897 = fsub contract <16 x float> %868, %808
  %898 = fsub contract <16 x float> %882, %822
  %899 = fsub contract <16 x float> %896, %836
  %900 = fmul contract <16 x float> %897, %897
  %901 = fmul contract <16 x float> %898, %898
  %902 = fadd contract <16 x float> %900, %901
  %903 = fmul contract <16 x float> %899, %899
  %904 = fadd contract <16 x float> %902, %903
  %905 = fmul contract <16 x float> %844, %844
  %906 = fcmp contract olt <16 x float> %904, %905
  %907 = bitcast <16 x i1> %906 to i16
  %908 = icmp eq i16 %907, 0
  br i1 %908, label %1250, label %909

909:
  call void @llvm.lifetime.start.p0(i64 16, ptr nonnull %7)
  store i64 %765, ptr %7, align 16
  store i64 %768, ptr %187, align 8
  br label %916

910:
  %911 = getelementptr inbounds i8, ptr %764, i64 16
  %912 = load i64, ptr %911, align 8
  %913 = getelementptr inbounds i8, ptr %764, i64 24
  %914 = load i64, ptr %913, align 8
  %915 = icmp slt i64 %912, %914
  br i1 %915, label %997, label %1248

916:
  %917 = phi i64 [ %762, %909 ], [ %994, %993 ]
  %918 = phi i64 [ 0, %909 ], [ %995, %993 ]
  %919 = getelementptr inbounds i8, ptr %7, i64 %918
  %920 = load i64, ptr %919, align 8
  %921 = shl nuw i64 1, %920
  %922 = and i64 %921, %917
  %923 = icmp eq i64 %922, 0
  br i1 %923, label %924, label %993

924:
  %925 = or i64 %921, %917
  %926 = getelementptr inbounds i64, ptr %189, i64 %920
  %927 = load i64, ptr %926, align 8
  %928 = getelementptr i8, ptr %926, i64 8
  %929 = load i64, ptr %928, align 8
  %930 = icmp slt i64 %927, %929
  br i1 %930, label %931, label %993

931:
  %932 = getelementptr inbounds %struct.Frame, ptr %11, i64 %920
  %933 = getelementptr inbounds i8, ptr %932, i64 576
  %934 = load <16 x float>, ptr %933, align 64
  %935 = load <16 x float>, ptr %932, align 64
  %936 = getelementptr inbounds i8, ptr %932, i64 64
  %937 = load <16 x float>, ptr %936, align 64
  %938 = getelementptr inbounds i8, ptr %932, i64 128
  %939 = load <16 x float>, ptr %938, align 64
  %940 = getelementptr inbounds i8, ptr %932, i64 640
  %941 = load <16 x float>, ptr %940, align 64
  %942 = getelementptr inbounds i8, ptr %932, i64 192
  %943 = load <16 x float>, ptr %942, align 64
  %944 = getelementptr inbounds i8, ptr %932, i64 256
  %945 = load <16 x float>, ptr %944, align 64
  %946 = getelementptr inbounds i8, ptr %932, i64 320
  %947 = load <16 x float>, ptr %946, align 64
  %948 = getelementptr inbounds i8, ptr %932, i64 704
  %949 = load <16 x float>, ptr %948, align 64
  %950 = getelementptr inbounds i8, ptr %932, i64 384
  %951 = load <16 x float>, ptr %950, align 64
  %952 = getelementptr inbounds i8, ptr %932, i64 448
  %953 = load <16 x float>, ptr %952, align 64
  %954 = getelementptr inbounds i8, ptr %932, i64 512
  %955 = load <16 x float>, ptr %954, align 64
  br label %956

956:
  %957 = phi i64 [ %927, %931 ], [ %991, %956 ]
  %958 = getelementptr inbounds %struct.Part, ptr %191, i64 %957
  %959 = load float, ptr %958, align 4
  %960 = getelementptr inbounds i8, ptr %958, i64 4
  %961 = load float, ptr %960, align 4
  %962 = getelementptr inbounds i8, ptr %958, i64 8
  %963 = load float, ptr %962, align 4
  %964 = insertelement <16 x float> poison, float %959, i64 0
  %965 = shufflevector <16 x float> %964, <16 x float> poison, <16 x i32> zeroinitializer
  %966 = fmul contract <16 x float> %965, %935
  %967 = fadd contract <16 x float> %934, %966
  %968 = insertelement <16 x float> poison, float %961, i64 0
  %969 = shufflevector <16 x float> %968, <16 x float> poison, <16 x i32> zeroinitializer
  %970 = fmul contract <16 x float> %969, %937
  %971 = fadd contract <16 x float> %967, %970
  %972 = insertelement <16 x float> poison, float %963, i64 0
  %973 = shufflevector <16 x float> %972, <16 x float> poison, <16 x i32> zeroinitializer
  %974 = fmul contract <16 x float> %973, %939
  %975 = fadd contract <16 x float> %971, %974
  %976 = fmul contract <16 x float> %965, %943
  %977 = fadd contract <16 x float> %941, %976
  %978 = fmul contract <16 x float> %969, %945
  %979 = fadd contract <16 x float> %977, %978
  %980 = fmul contract <16 x float> %973, %947
  %981 = fadd contract <16 x float> %979, %980
  %982 = fmul contract <16 x float> %965, %951
  %983 = fadd contract <16 x float> %949, %982
  %984 = fmul contract <16 x float> %969, %953
  %985 = fadd contract <16 x float> %983, %984
  %986 = fmul contract <16 x float> %973, %955
  %987 = fadd contract <16 x float> %985, %986
  %988 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %957
  store <16 x float> %975, ptr %988, align 64
  %989 = getelementptr inbounds i8, ptr %988, i64 64
  store <16 x float> %981, ptr %989, align 64
  %990 = getelementptr inbounds i8, ptr %988, i64 128
  store <16 x float> %987, ptr %990, align 64
  %991 = add nsw i64 %957, 1
  %992 = icmp eq i64 %991, %929
  br i1 %992, label %993, label %956

993:
  %994 = phi i64 [ %917, %916 ], [ %925, %924 ], [ %925, %956 ]
  %995 = add nuw nsw i64 %918, 8
  %996 = icmp eq i64 %995, 16
  br i1 %996, label %910, label %916

997:
  %998 = phi <16 x i32> [ %1245, %1242 ], [ %761, %910 ]
  %999 = phi i64 [ %1246, %1242 ], [ %912, %910 ]
  %1000 = phi i1 [ %1243, %1242 ], [ false, %910 ]
  %1001 = phi i64 [ %1244, %1242 ], [ -1, %910 ]
  %1002 = getelementptr inbounds %struct.PartPair, ptr %193, i64 %999
  %1003 = load i64, ptr %1002, align 8
  %1004 = getelementptr inbounds %struct.Part, ptr %191, i64 %1003
  %1005 = getelementptr inbounds i8, ptr %1002, i64 8
  %1006 = load i64, ptr %1005, align 8
  %1007 = getelementptr inbounds %struct.Part, ptr %191, i64 %1006
  %1008 = icmp eq i64 %1003, %1001
  br i1 %1008, label %1034, label %1009

1009:
  %1010 = getelementptr inbounds i8, ptr %1004, i64 28
  %1011 = load float, ptr %1010, align 4
  %1012 = fadd contract float %840, %1011
  %1013 = insertelement <16 x float> poison, float %1012, i64 0
  %1014 = shufflevector <16 x float> %1013, <16 x float> poison, <16 x i32> zeroinitializer
  %1015 = fadd contract <16 x float> %784, %1014
  %1016 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %1003
  %1017 = load <16 x float>, ptr %1016, align 64
  %1018 = fsub contract <16 x float> %1017, %808
  %1019 = getelementptr inbounds i8, ptr %1016, i64 64
  %1020 = load <16 x float>, ptr %1019, align 64
  %1021 = fsub contract <16 x float> %1020, %822
  %1022 = getelementptr inbounds i8, ptr %1016, i64 128
  %1023 = load <16 x float>, ptr %1022, align 64
  %1024 = fsub contract <16 x float> %1023, %836
  %1025 = fmul contract <16 x float> %1018, %1018
  %1026 = fmul contract <16 x float> %1021, %1021
  %1027 = fadd contract <16 x float> %1025, %1026
  %1028 = fmul contract <16 x float> %1024, %1024
  %1029 = fadd contract <16 x float> %1027, %1028
  %1030 = fmul contract <16 x float> %1015, %1015
  %1031 = fcmp contract olt <16 x float> %1029, %1030
  %1032 = bitcast <16 x i1> %1031 to i16
  %1033 = icmp eq i16 %1032, 0
  br i1 %1033, label %1242, label %1035

1034:
  br i1 %1000, label %1035, label %1242

1035:
  %1036 = phi i64 [ %1003, %1009 ], [ %1001, %1034 ]
  %1037 = getelementptr inbounds i8, ptr %1004, i64 28
  %1038 = load float, ptr %1037, align 4
  %1039 = getelementptr inbounds i8, ptr %1007, i64 28
  %1040 = load float, ptr %1039, align 4
  %1041 = fadd contract float %1038, %1040
  %1042 = insertelement <16 x float> poison, float %1041, i64 0
  %1043 = shufflevector <16 x float> %1042, <16 x float> poison, <16 x i32> zeroinitializer
  %1044 = fadd contract <16 x float> %784, %1043
  %1045 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %1003
  %1046 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %1006
  %1047 = load <16 x float>, ptr %1045, align 64
  %1048 = load <16 x float>, ptr %1046, align 64
  %1049 = fsub contract <16 x float> %1047, %1048
  %1050 = getelementptr inbounds i8, ptr %1045, i64 64
  %1051 = load <16 x float>, ptr %1050, align 64
  %1052 = getelementptr inbounds i8, ptr %1046, i64 64
  %1053 = load <16 x float>, ptr %1052, align 64
  %1054 = fsub contract <16 x float> %1051, %1053
  %1055 = getelementptr inbounds i8, ptr %1045, i64 128
  %1056 = load <16 x float>, ptr %1055, align 64
  %1057 = getelementptr inbounds i8, ptr %1046, i64 128
  %1058 = load <16 x float>, ptr %1057, align 64
  %1059 = fsub contract <16 x float> %1056, %1058
  %1060 = fmul contract <16 x float> %1049, %1049
  %1061 = fmul contract <16 x float> %1054, %1054
  %1062 = fadd contract <16 x float> %1060, %1061
  %1063 = fmul contract <16 x float> %1059, %1059
  %1064 = fadd contract <16 x float> %1062, %1063
  %1065 = fmul contract <16 x float> %1044, %1044
  %1066 = fcmp contract olt <16 x float> %1064, %1065
  %1067 = bitcast <16 x i1> %1066 to i16
  %1068 = icmp eq i16 %1067, 0
  br i1 %1068, label %1242, label %1069

1069:
  %1070 = getelementptr inbounds i8, ptr %1004, i64 24
  %1071 = load float, ptr %1070, align 4
  %1072 = getelementptr inbounds i8, ptr %1007, i64 24
  %1073 = load float, ptr %1072, align 4
  %1074 = fadd contract float %1071, %1073
  %1075 = insertelement <16 x float> poison, float %1074, i64 0
  %1076 = shufflevector <16 x float> %1075, <16 x float> poison, <16 x i32> zeroinitializer
  %1077 = fadd contract <16 x float> %784, %1076
  %1078 = getelementptr inbounds i8, ptr %1004, i64 12
  %1079 = load float, ptr %1078, align 4
  %1080 = fmul contract float %1079, %1079
  %1081 = getelementptr inbounds i8, ptr %1004, i64 16
  %1082 = load float, ptr %1081, align 4
  %1083 = fmul contract float %1082, %1082
  %1084 = fadd contract float %1080, %1083
  %1085 = getelementptr inbounds i8, ptr %1004, i64 20
  %1086 = load float, ptr %1085, align 4
  %1087 = fmul contract float %1086, %1086
  %1088 = fadd contract float %1084, %1087
  %1089 = getelementptr inbounds i8, ptr %1007, i64 12
  %1090 = load float, ptr %1089, align 4
  %1091 = fmul contract float %1090, %1090
  %1092 = getelementptr inbounds i8, ptr %1007, i64 16
  %1093 = load float, ptr %1092, align 4
  %1094 = fmul contract float %1093, %1093
  %1095 = fadd contract float %1091, %1094
  %1096 = getelementptr inbounds i8, ptr %1007, i64 20
  %1097 = load float, ptr %1096, align 4
  %1098 = fmul contract float %1097, %1097
  %1099 = fadd contract float %1095, %1098
  %1100 = fcmp contract oeq float %1088, 0.000000e+00
  %1101 = fcmp contract oeq float %1099, 0.000000e+00
  %1102 = select i1 %1100, i1 %1101, i1 false
  br i1 %1102, label %1234, label %1103

1103:
  %1104 = fmul contract <16 x float> %1047, zeroinitializer
  %1105 = fadd contract <16 x float> %1104, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %1106 = insertelement <16 x float> poison, float %1079, i64 0
  %1107 = shufflevector <16 x float> %1106, <16 x float> poison, <16 x i32> zeroinitializer
  %1108 = fmul contract <16 x float> %852, %1107
  %1109 = insertelement <16 x float> poison, float %1082, i64 0
  %1110 = shufflevector <16 x float> %1109, <16 x float> poison, <16 x i32> zeroinitializer
  %1111 = fmul contract <16 x float> %858, %1110
  %1112 = fadd contract <16 x float> %1108, %1111
  %1113 = insertelement <16 x float> poison, float %1086, i64 0
  %1114 = shufflevector <16 x float> %1113, <16 x float> poison, <16 x i32> zeroinitializer
  %1115 = fmul contract <16 x float> %864, %1114
  %1116 = fadd contract <16 x float> %1112, %1115
  %1117 = fmul contract <16 x float> %872, %1107
  %1118 = fmul contract <16 x float> %876, %1110
  %1119 = fadd contract <16 x float> %1117, %1118
  %1120 = fmul contract <16 x float> %880, %1114
  %1121 = fadd contract <16 x float> %1119, %1120
  %1122 = fmul contract <16 x float> %886, %1107
  %1123 = fmul contract <16 x float> %890, %1110
  %1124 = fadd contract <16 x float> %1122, %1123
  %1125 = fmul contract <16 x float> %894, %1114
  %1126 = fadd contract <16 x float> %1124, %1125
  %1127 = insertelement <16 x float> poison, float %1090, i64 0
  %1128 = shufflevector <16 x float> %1127, <16 x float> poison, <16 x i32> zeroinitializer
  %1129 = fmul contract <16 x float> %792, %1128
  %1130 = insertelement <16 x float> poison, float %1093, i64 0
  %1131 = shufflevector <16 x float> %1130, <16 x float> poison, <16 x i32> zeroinitializer
  %1132 = fmul contract <16 x float> %798, %1131
  %1133 = fadd contract <16 x float> %1129, %1132
  %1134 = insertelement <16 x float> poison, float %1097, i64 0
  %1135 = shufflevector <16 x float> %1134, <16 x float> poison, <16 x i32> zeroinitializer
  %1136 = fmul contract <16 x float> %804, %1135
  %1137 = fadd contract <16 x float> %1133, %1136
  %1138 = fmul contract <16 x float> %812, %1128
  %1139 = fmul contract <16 x float> %816, %1131
  %1140 = fadd contract <16 x float> %1138, %1139
  %1141 = fmul contract <16 x float> %820, %1135
  %1142 = fadd contract <16 x float> %1140, %1141
  %1143 = fmul contract <16 x float> %826, %1128
  %1144 = fmul contract <16 x float> %830, %1131
  %1145 = fadd contract <16 x float> %1143, %1144
  %1146 = fmul contract <16 x float> %834, %1135
  %1147 = fadd contract <16 x float> %1145, %1146
  %1148 = fcmp contract ogt float %1088, 0.000000e+00
  %1149 = fdiv contract float 1.000000e+00, %1088
  %1150 = select contract i1 %1148, float %1149, float 0.000000e+00
  %1151 = fcmp contract ogt float %1099, 0.000000e+00
  %1152 = fdiv contract float 1.000000e+00, %1099
  %1153 = select contract i1 %1151, float %1152, float 0.000000e+00
  %1154 = fmul contract <16 x float> %1116, %1137
  %1155 = fmul contract <16 x float> %1121, %1142
  %1156 = fadd contract <16 x float> %1154, %1155
  %1157 = fmul contract <16 x float> %1126, %1147
  %1158 = fadd contract <16 x float> %1157, %1156
  %1159 = fmul contract <16 x float> %1049, %1116
  %1160 = fmul contract <16 x float> %1054, %1121
  %1161 = fadd contract <16 x float> %1159, %1160
  %1162 = fmul contract <16 x float> %1059, %1126
  %1163 = fadd contract <16 x float> %1162, %1161
  %1164 = fmul contract <16 x float> %1049, %1137
  %1165 = fmul contract <16 x float> %1054, %1142
  %1166 = fadd contract <16 x float> %1164, %1165
  %1167 = fmul contract <16 x float> %1059, %1147
  %1168 = fadd contract <16 x float> %1167, %1166
  %1169 = fmul contract float %1088, %1099
  %1170 = insertelement <16 x float> poison, float %1169, i64 0
  %1171 = shufflevector <16 x float> %1170, <16 x float> poison, <16 x i32> zeroinitializer
  %1172 = fmul contract <16 x float> %1158, %1158
  %1173 = fsub contract <16 x float> %1171, %1172
  %1174 = fmul contract float %1088, 0x3E7AD7F2A0000000
  %1175 = fmul contract float %1174, %1099
  %1176 = insertelement <16 x float> poison, float %1175, i64 0
  %1177 = shufflevector <16 x float> %1176, <16 x float> poison, <16 x i32> zeroinitializer
  %1178 = fcmp contract ogt <16 x float> %1173, %1177
  %1179 = fmul contract <16 x float> %1158, %1168
  %1180 = insertelement <16 x float> poison, float %1099, i64 0
  %1181 = shufflevector <16 x float> %1180, <16 x float> poison, <16 x i32> zeroinitializer
  %1182 = fmul contract <16 x float> %1181, %1163
  %1183 = fsub contract <16 x float> %1179, %1182
  %1184 = select contract <16 x i1> %1178, <16 x float> %1173, <16 x float> %1105
  %1185 = fdiv contract <16 x float> %1183, %1184
  %1186 = fneg contract <16 x float> %1105
  %1187 = fcmp contract ogt <16 x float> %1185, %1186
  %1188 = select contract <16 x i1> %1187, <16 x float> %1185, <16 x float> %1186
  %1189 = fcmp contract olt <16 x float> %1188, %1105
  %1190 = select contract <16 x i1> %1189, <16 x float> %1188, <16 x float> %1105
  %1191 = select contract <16 x i1> %1178, <16 x float> %1190, <16 x float> %1186
  %1192 = fmul contract <16 x float> %1158, %1191
  %1193 = fadd contract <16 x float> %1168, %1192
  %1194 = insertelement <16 x float> poison, float %1153, i64 0
  %1195 = shufflevector <16 x float> %1194, <16 x float> poison, <16 x i32> zeroinitializer
  %1196 = fmul contract <16 x float> %1195, %1193
  %1197 = fcmp contract ogt <16 x float> %1196, %1186
  %1198 = select contract <16 x i1> %1197, <16 x float> %1196, <16 x float> %1186
  %1199 = fcmp contract olt <16 x float> %1198, %1105
  %1200 = select contract <16 x i1> %1199, <16 x float> %1198, <16 x float> %1105
  %1201 = fmul contract <16 x float> %1158, %1200
  %1202 = fsub contract <16 x float> %1201, %1163
  %1203 = insertelement <16 x float> poison, float %1150, i64 0
  %1204 = shufflevector <16 x float> %1203, <16 x float> poison, <16 x i32> zeroinitializer
  %1205 = fmul contract <16 x float> %1204, %1202
  %1206 = fcmp contract ogt <16 x float> %1205, %1186
  %1207 = select contract <16 x i1> %1206, <16 x float> %1205, <16 x float> %1186
  %1208 = fcmp contract olt <16 x float> %1207, %1105
  %1209 = select contract <16 x i1> %1208, <16 x float> %1207, <16 x float> %1105
  %1210 = fmul contract <16 x float> %1158, %1209
  %1211 = fadd contract <16 x float> %1168, %1210
  %1212 = fmul contract <16 x float> %1195, %1211
  %1213 = fcmp contract ogt <16 x float> %1212, %1186
  %1214 = select contract <16 x i1> %1213, <16 x float> %1212, <16 x float> %1186
  %1215 = fcmp contract olt <16 x float> %1214, %1105
  %1216 = select contract <16 x i1> %1215, <16 x float> %1214, <16 x float> %1105
  %1217 = fmul contract <16 x float> %1116, %1209
  %1218 = fadd contract <16 x float> %1049, %1217
  %1219 = fmul contract <16 x float> %1137, %1216
  %1220 = fsub contract <16 x float> %1218, %1219
  %1221 = fmul contract <16 x float> %1121, %1209
  %1222 = fadd contract <16 x float> %1054, %1221
  %1223 = fmul contract <16 x float> %1142, %1216
  %1224 = fsub contract <16 x float> %1222, %1223
  %1225 = fmul contract <16 x float> %1126, %1209
  %1226 = fadd contract <16 x float> %1059, %1225
  %1227 = fmul contract <16 x float> %1147, %1216
  %1228 = fsub contract <16 x float> %1226, %1227
  %1229 = fmul contract <16 x float> %1220, %1220
  %1230 = fmul contract <16 x float> %1224, %1224
  %1231 = fadd contract <16 x float> %1229, %1230
  %1232 = fmul contract <16 x float> %1228, %1228
  %1233 = fadd contract <16 x float> %1232, %1231
  br label %1234

1234:
  %1235 = phi <16 x float> [ %1233, %1103 ], [ %1064, %1069 ]
  %1236 = fmul contract <16 x float> %1077, %1077
  %1237 = fcmp contract olt <16 x float> %1235, %1236
  %1238 = select <16 x i1> %1237, <16 x i32> <i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1>, <16 x i32> %998
  %1239 = icmp ne <16 x i32> %1238, zeroinitializer
  %1240 = bitcast <16 x i1> %1239 to i16
  %1241 = icmp eq i16 %1240, 0
  br i1 %1241, label %1242, label %1255

1242:
  %1243 = phi i1 [ true, %1035 ], [ false, %1034 ], [ true, %1234 ], [ false, %1009 ]
  %1244 = phi i64 [ %1036, %1035 ], [ %1001, %1034 ], [ %1036, %1234 ], [ %1003, %1009 ]
  %1245 = phi <16 x i32> [ %998, %1035 ], [ %998, %1034 ], [ %1238, %1234 ], [ %998, %1009 ]
  %1246 = add i64 %999, 1
  %1247 = icmp eq i64 %1246, %914
  br i1 %1247, label %1248, label %997

1248:
  %1249 = phi <16 x i32> [ %761, %910 ], [ %1245, %1242 ]
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %7)
  br label %1250

1250:
  %1251 = phi <16 x i32> [ %1249, %1248 ], [ %761, %760 ]
  %1252 = phi i64 [ %994, %1248 ], [ %762, %760 ]
  %1253 = add nuw nsw i64 %763, 1
  %1254 = icmp eq i64 %1253, %21
  br i1 %1254, label %1256, label %760

1255:
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %7)
  br label %1256

1256:
  %1257 = phi <16 x i32> [ %1238, %1255 ], [ %759, %758 ], [ %1251, %1250 ]
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %6)
  br label %1258

1258:
  %1259 = phi <16 x i32> [ %1257, %1256 ], [ %741, %737 ], [ %746, %745 ]
  %1260 = icmp ne <16 x i32> %1259, zeroinitializer
  %1261 = bitcast <16 x i1> %1260 to i16
  %1262 = icmp eq i16 %1261, 0
  br i1 %1262, label %203, label %1263

1263:
  %1264 = phi i1 [ true, %153 ], [ %205, %203 ], [ %208, %1258 ]
  call void @llvm.lifetime.end.p0(i64 13056, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %10)
  call void @llvm.lifetime.end.p0(i64 1224, ptr nonnull %9)
  ret i1 %1264
}

declare void @llvm.lifetime.end.p0(i64 immarg, ptr nocapture)

define void @prove_edges(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3, i64 noundef %4, double noundef %5, ptr nocapture noundef writeonly %6) {
  %8 = alloca [192 x %struct.Point.4], align 64
  %9 = alloca [2 x i64], align 16
  %10 = alloca [9 x <8 x double>], align 64
  %11 = alloca %struct.Motion.1, align 8
  %12 = alloca [4096 x %struct.Piece], align 16
  %13 = alloca [17 x %struct.Frame.2], align 64
  %14 = alloca [8 x %struct.Piece], align 16
  %15 = load i64, ptr %0, align 8
  %16 = icmp sgt i64 %4, 0
  br i1 %16, label %17, label %39

17:
  %18 = getelementptr inbounds i8, ptr %0, i64 112
  %19 = getelementptr inbounds i8, ptr %11, i64 136
  %20 = getelementptr inbounds i8, ptr %0, i64 16
  %21 = getelementptr inbounds i8, ptr %0, i64 120
  %22 = getelementptr inbounds i8, ptr %11, i64 272
  %23 = getelementptr inbounds i8, ptr %11, i64 1360
  %24 = getelementptr inbounds i8, ptr %13, i64 576
  %25 = getelementptr inbounds i8, ptr %0, i64 24
  %26 = getelementptr inbounds i8, ptr %0, i64 48
  %27 = getelementptr inbounds i8, ptr %0, i64 8
  %28 = getelementptr inbounds i8, ptr %0, i64 56
  %29 = getelementptr inbounds i8, ptr %0, i64 64
  %30 = getelementptr inbounds i8, ptr %0, i64 32
  %31 = getelementptr inbounds i8, ptr %0, i64 40
  %32 = getelementptr inbounds i8, ptr %0, i64 96
  %33 = getelementptr inbounds i8, ptr %0, i64 88
  %34 = getelementptr inbounds i8, ptr %0, i64 128
  %35 = getelementptr inbounds i8, ptr %9, i64 8
  %36 = getelementptr inbounds i8, ptr %0, i64 80
  %37 = getelementptr inbounds i8, ptr %0, i64 72
  %38 = getelementptr inbounds i8, ptr %0, i64 104
  br label %40

39:
  ret void

40:
  %41 = phi i64 [ 0, %17 ], [ %1304, %1301 ]
  %42 = mul nsw i64 %41, %15
  %43 = getelementptr inbounds double, ptr %1, i64 %42
  %44 = getelementptr inbounds double, ptr %2, i64 %42
  %45 = getelementptr inbounds double, ptr %3, i64 %42
  call void @llvm.lifetime.start.p0(i64 2448, ptr nonnull %11)
  %46 = load i64, ptr %0, align 8
  %47 = icmp slt i64 %46, 0
  br i1 %47, label %51, label %48

48:
  %49 = icmp eq i64 %46, 0
  %50 = load ptr, ptr %18, align 8
  br label %57

51:
  %52 = load i64, ptr %20, align 8
  %53 = icmp sgt i64 %52, 0
  br i1 %53, label %54, label %139

54:
  %55 = icmp sgt i64 %46, 0
  %56 = load ptr, ptr %21, align 8
  br label %98

57:
  %58 = phi i64 [ 0, %48 ], [ %96, %93 ]
  %59 = mul nuw nsw i64 %58, %46
  %60 = getelementptr inbounds double, ptr %50, i64 %59
  br i1 %49, label %61, label %63

61:
  %62 = getelementptr inbounds [17 x double], ptr %11, i64 0, i64 %58
  store double 0.000000e+00, ptr %62, align 8
  br label %93

63:
  %64 = phi i64 [ %75, %63 ], [ 0, %57 ]
  %65 = phi double [ %74, %63 ], [ 0.000000e+00, %57 ]
  %66 = getelementptr inbounds double, ptr %60, i64 %64
  %67 = load double, ptr %66, align 8
  %68 = getelementptr inbounds double, ptr %44, i64 %64
  %69 = load double, ptr %68, align 8
  %70 = fcmp contract olt double %69, 0.000000e+00
  %71 = fneg contract double %69
  %72 = select contract i1 %70, double %71, double %69
  %73 = fmul contract double %67, %72
  %74 = fadd contract double %65, %73
  %75 = add nuw nsw i64 %64, 1
  %76 = icmp eq i64 %75, %46
  br i1 %76, label %77, label %63

77:
  %78 = getelementptr inbounds [17 x double], ptr %11, i64 0, i64 %58
  store double %74, ptr %78, align 8
  br label %79

79:
  %80 = phi i64 [ %91, %79 ], [ 0, %77 ]
  %81 = phi double [ %90, %79 ], [ 0.000000e+00, %77 ]
  %82 = getelementptr inbounds double, ptr %60, i64 %80
  %83 = load double, ptr %82, align 8
  %84 = getelementptr inbounds double, ptr %45, i64 %80
  %85 = load double, ptr %84, align 8
  %86 = fcmp contract olt double %85, 0.000000e+00
  %87 = fneg contract double %85
  %88 = select contract i1 %86, double %87, double %85
  %89 = fmul contract double %83, %88
  %90 = fadd contract double %81, %89
  %91 = add nuw nsw i64 %80, 1
  %92 = icmp eq i64 %91, %46
  br i1 %92, label %93, label %79

93:
  %94 = phi double [ 0.000000e+00, %61 ], [ %90, %79 ]
  %95 = getelementptr inbounds [17 x double], ptr %19, i64 0, i64 %58
  store double %94, ptr %95, align 8
  %96 = add nuw i64 %58, 1
  %97 = icmp eq i64 %58, %46
  br i1 %97, label %51, label %57

98:
  %99 = phi i64 [ 0, %54 ], [ %137, %134 ]
  %100 = mul nsw i64 %99, %46
  %101 = getelementptr inbounds double, ptr %56, i64 %100
  br i1 %55, label %104, label %102

102:
  %103 = getelementptr inbounds [136 x double], ptr %22, i64 0, i64 %99
  store double 0.000000e+00, ptr %103, align 8
  br label %134

104:
  %105 = phi i64 [ %116, %104 ], [ 0, %98 ]
  %106 = phi double [ %115, %104 ], [ 0.000000e+00, %98 ]
  %107 = getelementptr inbounds double, ptr %101, i64 %105
  %108 = load double, ptr %107, align 8
  %109 = getelementptr inbounds double, ptr %44, i64 %105
  %110 = load double, ptr %109, align 8
  %111 = fcmp contract olt double %110, 0.000000e+00
  %112 = fneg contract double %110
  %113 = select contract i1 %111, double %112, double %110
  %114 = fmul contract double %108, %113
  %115 = fadd contract double %106, %114
  %116 = add nuw nsw i64 %105, 1
  %117 = icmp eq i64 %116, %46
  br i1 %117, label %118, label %104

118:
  %119 = getelementptr inbounds [136 x double], ptr %22, i64 0, i64 %99
  store double %115, ptr %119, align 8
  br label %120

120:
  %121 = phi i64 [ %132, %120 ], [ 0, %118 ]
  %122 = phi double [ %131, %120 ], [ 0.000000e+00, %118 ]
  %123 = getelementptr inbounds double, ptr %101, i64 %121
  %124 = load double, ptr %123, align 8
  %125 = getelementptr inbounds double, ptr %45, i64 %121
  %126 = load double, ptr %125, align 8
  %127 = fcmp contract olt double %126, 0.000000e+00
  %128 = fneg contract double %126
  %129 = select contract i1 %127, double %128, double %126
  %130 = fmul contract double %124, %129
  %131 = fadd contract double %122, %130
  %132 = add nuw nsw i64 %121, 1
  %133 = icmp eq i64 %132, %46
  br i1 %133, label %134, label %120

134:
  %135 = phi double [ 0.000000e+00, %102 ], [ %131, %120 ]
  %136 = getelementptr inbounds [136 x double], ptr %23, i64 0, i64 %99
  store double %135, ptr %136, align 8
  %137 = add nuw nsw i64 %99, 1
  %138 = icmp eq i64 %137, %52
  br i1 %138, label %139, label %98

139:
  br i1 %47, label %140, label %142

140:
  %141 = phi double [ 0.000000e+00, %139 ], [ %148, %142 ]
  br i1 %53, label %151, label %160

142:
  %143 = phi i64 [ %149, %142 ], [ 0, %139 ]
  %144 = phi double [ %148, %142 ], [ 0.000000e+00, %139 ]
  %145 = getelementptr inbounds [17 x double], ptr %11, i64 0, i64 %143
  %146 = load double, ptr %145, align 8
  %147 = fcmp contract ogt double %146, %144
  %148 = select i1 %147, double %146, double %144
  %149 = add nuw i64 %143, 1
  %150 = icmp eq i64 %143, %46
  br i1 %150, label %140, label %142

151:
  %152 = phi i64 [ %158, %151 ], [ 0, %140 ]
  %153 = phi double [ %157, %151 ], [ %141, %140 ]
  %154 = getelementptr inbounds [136 x double], ptr %22, i64 0, i64 %152
  %155 = load double, ptr %154, align 8
  %156 = fcmp contract ogt double %155, %153
  %157 = select i1 %156, double %155, double %153
  %158 = add nuw nsw i64 %152, 1
  %159 = icmp eq i64 %158, %52
  br i1 %159, label %160, label %151

160:
  %161 = phi double [ %141, %140 ], [ %157, %151 ]
  call void @llvm.lifetime.start.p0(i64 65536, ptr nonnull %12)
  br label %178

162:
  call void @llvm.lifetime.start.p0(i64 13056, ptr nonnull %13)
  %163 = icmp sgt i64 %46, 0
  %164 = load ptr, ptr %25, align 8
  %165 = load ptr, ptr %26, align 8
  %166 = load i64, ptr %27, align 8
  %167 = icmp sgt i64 %166, 0
  %168 = load ptr, ptr %28, align 8
  %169 = load ptr, ptr %29, align 8
  %170 = load ptr, ptr %30, align 8
  %171 = load ptr, ptr %31, align 8
  %172 = load ptr, ptr %32, align 8
  %173 = load ptr, ptr %33, align 8
  %174 = load ptr, ptr %34, align 8
  %175 = load ptr, ptr %36, align 8
  %176 = load ptr, ptr %37, align 8
  %177 = load ptr, ptr %38, align 8
  br label %188

178:
  %179 = phi i64 [ 0, %160 ], [ %184, %178 ]
  %180 = uitofp nneg i64 %179 to double
  %181 = fmul contract double %180, 2.000000e+00
  %182 = fadd contract double %181, 1.000000e+00
  %183 = fmul contract double %182, 6.250000e-02
  %184 = add nuw nsw i64 %179, 1
  %185 = getelementptr inbounds [4096 x %struct.Piece], ptr %12, i64 0, i64 %179
  store double %183, ptr %185, align 16
  %186 = getelementptr inbounds i8, ptr %185, i64 8
  store double 6.250000e-02, ptr %186, align 8
  %187 = icmp eq i64 %184, 8
  br i1 %187, label %162, label %178

188:
  %189 = phi i64 [ 8, %162 ], [ %1299, %1298 ]
  %190 = phi <8 x double> [ undef, %162 ], [ %1262, %1298 ]
  %191 = phi <8 x double> [ undef, %162 ], [ %1265, %1298 ]
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %14)
  br label %1251

192:
  %193 = fmul contract <8 x double> %1262, zeroinitializer
  br label %194

194:
  %195 = phi i64 [ 0, %192 ], [ %203, %194 ]
  %196 = and i64 %195, 3
  %197 = icmp eq i64 %196, 0
  %198 = uitofp i1 %197 to double
  %199 = insertelement <8 x double> poison, double %198, i64 0
  %200 = shufflevector <8 x double> %199, <8 x double> poison, <8 x i32> zeroinitializer
  %201 = fadd contract <8 x double> %193, %200
  %202 = getelementptr inbounds [9 x <8 x double>], ptr %13, i64 0, i64 %195
  store <8 x double> %201, ptr %202, align 64
  %203 = add nuw nsw i64 %195, 1
  %204 = icmp eq i64 %203, 9
  br i1 %204, label %208, label %194

205:
  %206 = tail call i64 @llvm.smin.i64(i64 %189, i64 8)
  %207 = sub nsw i64 %189, %206
  br i1 %163, label %213, label %747

208:
  %209 = phi i64 [ %211, %208 ], [ 0, %194 ]
  %210 = getelementptr inbounds [3 x <8 x double>], ptr %24, i64 0, i64 %209
  store <8 x double> %193, ptr %210, align 64
  %211 = add nuw nsw i64 %209, 1
  %212 = icmp eq i64 %211, 3
  br i1 %212, label %205, label %208

213:
  %214 = phi i64 [ %270, %423 ], [ 0, %205 ]
  %215 = getelementptr inbounds %struct.Joint.3, ptr %164, i64 %214
  %216 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %214
  %217 = getelementptr inbounds double, ptr %43, i64 %214
  %218 = load double, ptr %217, align 8
  %219 = getelementptr inbounds double, ptr %44, i64 %214
  %220 = load double, ptr %219, align 8
  %221 = insertelement <8 x double> poison, double %220, i64 0
  %222 = shufflevector <8 x double> %221, <8 x double> poison, <8 x i32> zeroinitializer
  %223 = getelementptr inbounds i8, ptr %215, i64 72
  %224 = load double, ptr %223, align 8
  %225 = getelementptr inbounds i8, ptr %215, i64 80
  %226 = load double, ptr %225, align 8
  %227 = getelementptr inbounds i8, ptr %215, i64 88
  %228 = load double, ptr %227, align 8
  %229 = getelementptr inbounds i8, ptr %216, i64 576
  %230 = load <8 x double>, ptr %229, align 64
  %231 = load <8 x double>, ptr %216, align 64
  %232 = insertelement <8 x double> poison, double %224, i64 0
  %233 = shufflevector <8 x double> %232, <8 x double> poison, <8 x i32> zeroinitializer
  %234 = getelementptr inbounds i8, ptr %216, i64 64
  %235 = load <8 x double>, ptr %234, align 64
  %236 = insertelement <8 x double> poison, double %226, i64 0
  %237 = shufflevector <8 x double> %236, <8 x double> poison, <8 x i32> zeroinitializer
  %238 = getelementptr inbounds i8, ptr %216, i64 128
  %239 = load <8 x double>, ptr %238, align 64
  %240 = insertelement <8 x double> poison, double %228, i64 0
  %241 = shufflevector <8 x double> %240, <8 x double> poison, <8 x i32> zeroinitializer
  %242 = getelementptr inbounds i8, ptr %216, i64 640
  %243 = load <8 x double>, ptr %242, align 64
  %244 = getelementptr inbounds i8, ptr %216, i64 192
  %245 = load <8 x double>, ptr %244, align 64
  %246 = getelementptr inbounds i8, ptr %216, i64 256
  %247 = load <8 x double>, ptr %246, align 64
  %248 = getelementptr inbounds i8, ptr %216, i64 320
  %249 = load <8 x double>, ptr %248, align 64
  %250 = getelementptr inbounds i8, ptr %216, i64 704
  %251 = load <8 x double>, ptr %250, align 64
  %252 = getelementptr inbounds i8, ptr %216, i64 384
  %253 = load <8 x double>, ptr %252, align 64
  %254 = getelementptr inbounds i8, ptr %216, i64 448
  %255 = load <8 x double>, ptr %254, align 64
  %256 = getelementptr inbounds i8, ptr %216, i64 512
  %257 = load <8 x double>, ptr %256, align 64
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %10)
  br label %258

258:
  %259 = phi i64 [ 0, %213 ], [ %301, %300 ]
  %260 = mul nuw nsw i64 %259, 3
  %261 = getelementptr inbounds [9 x <8 x double>], ptr %216, i64 0, i64 %260
  %262 = load <8 x double>, ptr %261, align 64
  %263 = add nuw nsw i64 %260, 1
  %264 = getelementptr inbounds [9 x <8 x double>], ptr %216, i64 0, i64 %263
  %265 = load <8 x double>, ptr %264, align 64
  %266 = add nuw nsw i64 %260, 2
  %267 = getelementptr inbounds [9 x <8 x double>], ptr %216, i64 0, i64 %266
  %268 = load <8 x double>, ptr %267, align 64
  br label %303

269:
  %270 = add nuw nsw i64 %214, 1
  %271 = insertelement <8 x double> poison, double %218, i64 0
  %272 = fmul contract <8 x double> %1262, %222
  %273 = fmul contract <8 x double> %233, %231
  %274 = fmul contract <8 x double> %237, %235
  %275 = fmul contract <8 x double> %241, %239
  %276 = fmul contract <8 x double> %233, %245
  %277 = fmul contract <8 x double> %237, %247
  %278 = fmul contract <8 x double> %241, %249
  %279 = fmul contract <8 x double> %233, %253
  %280 = fmul contract <8 x double> %237, %255
  %281 = fmul contract <8 x double> %241, %257
  %282 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %270
  %283 = shufflevector <8 x double> %271, <8 x double> poison, <8 x i32> zeroinitializer
  %284 = fadd contract <8 x double> %283, %272
  %285 = fadd contract <8 x double> %230, %273
  %286 = fadd contract <8 x double> %285, %274
  %287 = fadd contract <8 x double> %286, %275
  %288 = fadd contract <8 x double> %243, %276
  %289 = fadd contract <8 x double> %288, %277
  %290 = fadd contract <8 x double> %289, %278
  %291 = fadd contract <8 x double> %251, %279
  %292 = fadd contract <8 x double> %291, %280
  %293 = fadd contract <8 x double> %292, %281
  %294 = getelementptr inbounds i8, ptr %282, i64 576
  store <8 x double> %287, ptr %294, align 64
  %295 = getelementptr inbounds i8, ptr %282, i64 640
  store <8 x double> %290, ptr %295, align 64
  %296 = getelementptr inbounds i8, ptr %282, i64 704
  store <8 x double> %293, ptr %296, align 64
  %297 = getelementptr inbounds i8, ptr %215, i64 96
  %298 = load double, ptr %297, align 8
  %299 = fcmp contract une double %298, 0.000000e+00
  br i1 %299, label %328, label %347

300:
  %301 = add nuw nsw i64 %259, 1
  %302 = icmp eq i64 %301, 3
  br i1 %302, label %269, label %258

303:
  %304 = phi i64 [ 0, %258 ], [ %326, %303 ]
  %305 = getelementptr inbounds [9 x double], ptr %215, i64 0, i64 %304
  %306 = load double, ptr %305, align 8
  %307 = insertelement <8 x double> poison, double %306, i64 0
  %308 = shufflevector <8 x double> %307, <8 x double> poison, <8 x i32> zeroinitializer
  %309 = fmul contract <8 x double> %262, %308
  %310 = add nuw nsw i64 %304, 3
  %311 = getelementptr inbounds [9 x double], ptr %215, i64 0, i64 %310
  %312 = load double, ptr %311, align 8
  %313 = insertelement <8 x double> poison, double %312, i64 0
  %314 = shufflevector <8 x double> %313, <8 x double> poison, <8 x i32> zeroinitializer
  %315 = fmul contract <8 x double> %265, %314
  %316 = fadd contract <8 x double> %309, %315
  %317 = add nuw nsw i64 %304, 6
  %318 = getelementptr inbounds [9 x double], ptr %215, i64 0, i64 %317
  %319 = load double, ptr %318, align 8
  %320 = insertelement <8 x double> poison, double %319, i64 0
  %321 = shufflevector <8 x double> %320, <8 x double> poison, <8 x i32> zeroinitializer
  %322 = fmul contract <8 x double> %268, %321
  %323 = fadd contract <8 x double> %316, %322
  %324 = add nuw nsw i64 %304, %260
  %325 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %324
  store <8 x double> %323, ptr %325, align 64
  %326 = add nuw nsw i64 %304, 1
  %327 = icmp eq i64 %326, 3
  br i1 %327, label %300, label %303

328:
  %329 = phi i64 [ %333, %328 ], [ 0, %269 ]
  %330 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %329
  %331 = load <8 x double>, ptr %330, align 64
  %332 = getelementptr inbounds [9 x <8 x double>], ptr %282, i64 0, i64 %329
  store <8 x double> %331, ptr %332, align 64
  %333 = add nuw nsw i64 %329, 1
  %334 = icmp eq i64 %333, 9
  br i1 %334, label %335, label %328

335:
  %336 = phi i64 [ %345, %335 ], [ 0, %328 ]
  %337 = mul nuw nsw i64 %336, 3
  %338 = add nuw nsw i64 %337, 2
  %339 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %338
  %340 = load <8 x double>, ptr %339, align 64
  %341 = fmul contract <8 x double> %284, %340
  %342 = getelementptr inbounds [3 x <8 x double>], ptr %294, i64 0, i64 %336
  %343 = load <8 x double>, ptr %342, align 64
  %344 = fadd contract <8 x double> %343, %341
  store <8 x double> %344, ptr %342, align 64
  %345 = add nuw nsw i64 %336, 1
  %346 = icmp eq i64 %345, 3
  br i1 %346, label %423, label %335

347:
  %348 = fmul contract <8 x double> %284, <double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883>
  %349 = fadd contract <8 x double> %348, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %350 = fadd contract <8 x double> %349, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %351 = fmul contract <8 x double> %350, <double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000>
  %352 = fsub contract <8 x double> %284, %351
  %353 = fmul contract <8 x double> %350, <double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000>
  %354 = fsub contract <8 x double> %352, %353
  %355 = fmul contract <8 x double> %350, <double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925>
  %356 = fsub contract <8 x double> %354, %355
  %357 = fmul contract <8 x double> %350, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %358 = fadd contract <8 x double> %357, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %359 = fadd contract <8 x double> %358, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %360 = fsub contract <8 x double> %357, %359
  %361 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %360)
  %362 = fmul contract <8 x double> %361, <double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00>
  %363 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %362
  %364 = fmul contract <8 x double> %356, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %365 = fmul contract <8 x double> %364, %364
  %366 = fmul contract <8 x double> %364, %365
  %367 = fmul contract <8 x double> %365, <double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C>
  %368 = fadd contract <8 x double> %367, <double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB>
  %369 = fmul contract <8 x double> %365, %368
  %370 = fadd contract <8 x double> %369, <double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D>
  %371 = fmul contract <8 x double> %365, %370
  %372 = fadd contract <8 x double> %371, <double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5>
  %373 = fmul contract <8 x double> %365, %372
  %374 = fadd contract <8 x double> %373, <double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6>
  %375 = fmul contract <8 x double> %365, %374
  %376 = fadd contract <8 x double> %375, <double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549>
  %377 = fmul contract <8 x double> %366, %376
  %378 = fadd contract <8 x double> %364, %377
  %379 = fmul contract <8 x double> %365, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %380 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %379
  %381 = fmul contract <8 x double> %365, %365
  %382 = fmul contract <8 x double> %365, <double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4>
  %383 = fsub contract <8 x double> <double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4>, %382
  %384 = fmul contract <8 x double> %365, %383
  %385 = fadd contract <8 x double> %384, <double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD>
  %386 = fmul contract <8 x double> %365, %385
  %387 = fadd contract <8 x double> %386, <double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590>
  %388 = fmul contract <8 x double> %365, %387
  %389 = fadd contract <8 x double> %388, <double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177>
  %390 = fmul contract <8 x double> %365, %389
  %391 = fadd contract <8 x double> %390, <double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C>
  %392 = fmul contract <8 x double> %381, %391
  %393 = fadd contract <8 x double> %380, %392
  %394 = fmul contract <8 x double> %363, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %395 = fmul contract <8 x double> %394, %378
  %396 = fmul contract <8 x double> %393, %395
  %397 = fmul contract <8 x double> %378, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %398 = fmul contract <8 x double> %378, %397
  %399 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %398
  %400 = fmul contract <8 x double> %363, %399
  br label %401

401:
  %402 = phi i64 [ 0, %347 ], [ %421, %401 ]
  %403 = mul nuw nsw i64 %402, 3
  %404 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %403
  %405 = load <8 x double>, ptr %404, align 64
  %406 = fmul contract <8 x double> %400, %405
  %407 = add nuw nsw i64 %403, 1
  %408 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %407
  %409 = load <8 x double>, ptr %408, align 64
  %410 = fmul contract <8 x double> %396, %409
  %411 = fadd contract <8 x double> %406, %410
  %412 = getelementptr inbounds [9 x <8 x double>], ptr %282, i64 0, i64 %403
  store <8 x double> %411, ptr %412, align 64
  %413 = fmul contract <8 x double> %400, %409
  %414 = fmul contract <8 x double> %396, %405
  %415 = fsub contract <8 x double> %413, %414
  %416 = getelementptr inbounds [9 x <8 x double>], ptr %282, i64 0, i64 %407
  store <8 x double> %415, ptr %416, align 64
  %417 = add nuw nsw i64 %403, 2
  %418 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %417
  %419 = load <8 x double>, ptr %418, align 64
  %420 = getelementptr inbounds [9 x <8 x double>], ptr %282, i64 0, i64 %417
  store <8 x double> %419, ptr %420, align 64
  %421 = add nuw nsw i64 %402, 1
  %422 = icmp eq i64 %421, 3
  br i1 %422, label %423, label %401

423:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %10)
  %424 = icmp eq i64 %270, %46
  br i1 %424, label %425, label %213

425:
  %426 = phi <8 x i64> [ %744, %743 ], [ zeroinitializer, %423 ]
  %427 = phi i64 [ %745, %743 ], [ 1, %423 ]
  %428 = getelementptr inbounds %struct.Sphere.5, ptr %165, i64 %427
  %429 = getelementptr inbounds i8, ptr %428, i64 24
  %430 = load double, ptr %429, align 8
  %431 = fcmp contract olt double %430, 0.000000e+00
  br i1 %431, label %743, label %432

432:
  %433 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %427
  %434 = load double, ptr %428, align 8
  %435 = getelementptr inbounds i8, ptr %428, i64 8
  %436 = load double, ptr %435, align 8
  %437 = getelementptr inbounds i8, ptr %428, i64 16
  %438 = load double, ptr %437, align 8
  %439 = getelementptr inbounds i8, ptr %433, i64 576
  %440 = load <8 x double>, ptr %439, align 64
  %441 = load <8 x double>, ptr %433, align 64
  %442 = insertelement <8 x double> poison, double %434, i64 0
  %443 = shufflevector <8 x double> %442, <8 x double> poison, <8 x i32> zeroinitializer
  %444 = fmul contract <8 x double> %443, %441
  %445 = fadd contract <8 x double> %440, %444
  %446 = getelementptr inbounds i8, ptr %433, i64 64
  %447 = load <8 x double>, ptr %446, align 64
  %448 = insertelement <8 x double> poison, double %436, i64 0
  %449 = shufflevector <8 x double> %448, <8 x double> poison, <8 x i32> zeroinitializer
  %450 = fmul contract <8 x double> %449, %447
  %451 = fadd contract <8 x double> %445, %450
  %452 = getelementptr inbounds i8, ptr %433, i64 128
  %453 = load <8 x double>, ptr %452, align 64
  %454 = insertelement <8 x double> poison, double %438, i64 0
  %455 = shufflevector <8 x double> %454, <8 x double> poison, <8 x i32> zeroinitializer
  %456 = fmul contract <8 x double> %455, %453
  %457 = fadd contract <8 x double> %451, %456
  %458 = getelementptr inbounds i8, ptr %433, i64 640
  %459 = load <8 x double>, ptr %458, align 64
  %460 = getelementptr inbounds i8, ptr %433, i64 192
  %461 = load <8 x double>, ptr %460, align 64
  %462 = fmul contract <8 x double> %443, %461
  %463 = fadd contract <8 x double> %459, %462
  %464 = getelementptr inbounds i8, ptr %433, i64 256
  %465 = load <8 x double>, ptr %464, align 64
  %466 = fmul contract <8 x double> %449, %465
  %467 = fadd contract <8 x double> %463, %466
  %468 = getelementptr inbounds i8, ptr %433, i64 320
  %469 = load <8 x double>, ptr %468, align 64
  %470 = fmul contract <8 x double> %455, %469
  %471 = fadd contract <8 x double> %467, %470
  %472 = getelementptr inbounds i8, ptr %433, i64 704
  %473 = load <8 x double>, ptr %472, align 64
  %474 = getelementptr inbounds i8, ptr %433, i64 384
  %475 = load <8 x double>, ptr %474, align 64
  %476 = fmul contract <8 x double> %443, %475
  %477 = fadd contract <8 x double> %473, %476
  %478 = getelementptr inbounds i8, ptr %433, i64 448
  %479 = load <8 x double>, ptr %478, align 64
  %480 = fmul contract <8 x double> %449, %479
  %481 = fadd contract <8 x double> %477, %480
  %482 = getelementptr inbounds i8, ptr %433, i64 512
  %483 = load <8 x double>, ptr %482, align 64
  %484 = fmul contract <8 x double> %455, %483
  %485 = fadd contract <8 x double> %481, %484
  %486 = getelementptr inbounds [17 x double], ptr %11, i64 0, i64 %427
  %487 = load double, ptr %486, align 8
  %488 = insertelement <8 x double> poison, double %487, i64 0
  %489 = shufflevector <8 x double> %488, <8 x double> poison, <8 x i32> zeroinitializer
  %490 = fmul contract <8 x double> %1265, %489
  %491 = getelementptr inbounds [17 x double], ptr %19, i64 0, i64 %427
  %492 = load double, ptr %491, align 8
  %493 = insertelement <8 x double> poison, double %492, i64 0
  %494 = shufflevector <8 x double> %493, <8 x double> poison, <8 x i32> zeroinitializer
  %495 = fadd contract <8 x double> %490, %494
  br i1 %167, label %496, label %743

496:
  %497 = mul nuw nsw i64 %427, %166
  %498 = getelementptr double, ptr %169, i64 %497
  %499 = getelementptr inbounds i64, ptr %170, i64 %427
  %500 = getelementptr inbounds i8, ptr %499, i64 8
  br label %501

501:
  %502 = phi <8 x i64> [ %426, %496 ], [ %740, %739 ]
  %503 = phi i64 [ 0, %496 ], [ %741, %739 ]
  %504 = getelementptr inbounds %struct.Object.6, ptr %168, i64 %503
  %505 = getelementptr double, ptr %498, i64 %503
  %506 = load double, ptr %505, align 8
  %507 = getelementptr inbounds i8, ptr %504, i64 120
  %508 = load double, ptr %507, align 8
  %509 = fadd contract double %506, %508
  %510 = fcmp contract olt double %509, -1.000000e+08
  br i1 %510, label %739, label %511

511:
  %512 = fadd contract double %430, %509
  %513 = insertelement <8 x double> poison, double %512, i64 0
  %514 = shufflevector <8 x double> %513, <8 x double> poison, <8 x i32> zeroinitializer
  %515 = fadd contract <8 x double> %495, %514
  %516 = getelementptr inbounds i8, ptr %504, i64 72
  %517 = load double, ptr %516, align 8
  %518 = insertelement <8 x double> poison, double %517, i64 0
  %519 = shufflevector <8 x double> %518, <8 x double> poison, <8 x i32> zeroinitializer
  %520 = load double, ptr %504, align 8
  %521 = insertelement <8 x double> poison, double %520, i64 0
  %522 = shufflevector <8 x double> %521, <8 x double> poison, <8 x i32> zeroinitializer
  %523 = fmul contract <8 x double> %457, %522
  %524 = fadd contract <8 x double> %519, %523
  %525 = getelementptr inbounds i8, ptr %504, i64 8
  %526 = load double, ptr %525, align 8
  %527 = insertelement <8 x double> poison, double %526, i64 0
  %528 = shufflevector <8 x double> %527, <8 x double> poison, <8 x i32> zeroinitializer
  %529 = fmul contract <8 x double> %471, %528
  %530 = fadd contract <8 x double> %524, %529
  %531 = getelementptr inbounds i8, ptr %504, i64 16
  %532 = load double, ptr %531, align 8
  %533 = insertelement <8 x double> poison, double %532, i64 0
  %534 = shufflevector <8 x double> %533, <8 x double> poison, <8 x i32> zeroinitializer
  %535 = fmul contract <8 x double> %485, %534
  %536 = fadd contract <8 x double> %530, %535
  %537 = getelementptr inbounds i8, ptr %504, i64 80
  %538 = load double, ptr %537, align 8
  %539 = insertelement <8 x double> poison, double %538, i64 0
  %540 = shufflevector <8 x double> %539, <8 x double> poison, <8 x i32> zeroinitializer
  %541 = getelementptr inbounds i8, ptr %504, i64 24
  %542 = load double, ptr %541, align 8
  %543 = insertelement <8 x double> poison, double %542, i64 0
  %544 = shufflevector <8 x double> %543, <8 x double> poison, <8 x i32> zeroinitializer
  %545 = fmul contract <8 x double> %457, %544
  %546 = fadd contract <8 x double> %540, %545
  %547 = getelementptr inbounds i8, ptr %504, i64 32
  %548 = load double, ptr %547, align 8
  %549 = insertelement <8 x double> poison, double %548, i64 0
  %550 = shufflevector <8 x double> %549, <8 x double> poison, <8 x i32> zeroinitializer
  %551 = fmul contract <8 x double> %471, %550
  %552 = fadd contract <8 x double> %546, %551
  %553 = getelementptr inbounds i8, ptr %504, i64 40
  %554 = load double, ptr %553, align 8
  %555 = insertelement <8 x double> poison, double %554, i64 0
  %556 = shufflevector <8 x double> %555, <8 x double> poison, <8 x i32> zeroinitializer
  %557 = fmul contract <8 x double> %485, %556
  %558 = fadd contract <8 x double> %552, %557
  %559 = getelementptr inbounds i8, ptr %504, i64 88
  %560 = load double, ptr %559, align 8
  %561 = insertelement <8 x double> poison, double %560, i64 0
  %562 = shufflevector <8 x double> %561, <8 x double> poison, <8 x i32> zeroinitializer
  %563 = getelementptr inbounds i8, ptr %504, i64 48
  %564 = load double, ptr %563, align 8
  %565 = insertelement <8 x double> poison, double %564, i64 0
  %566 = shufflevector <8 x double> %565, <8 x double> poison, <8 x i32> zeroinitializer
  %567 = fmul contract <8 x double> %457, %566
  %568 = fadd contract <8 x double> %562, %567
  %569 = getelementptr inbounds i8, ptr %504, i64 56
  %570 = load double, ptr %569, align 8
  %571 = insertelement <8 x double> poison, double %570, i64 0
  %572 = shufflevector <8 x double> %571, <8 x double> poison, <8 x i32> zeroinitializer
  %573 = fmul contract <8 x double> %471, %572
  %574 = fadd contract <8 x double> %568, %573
  %575 = getelementptr inbounds i8, ptr %504, i64 64
  %576 = load double, ptr %575, align 8
  %577 = insertelement <8 x double> poison, double %576, i64 0
  %578 = shufflevector <8 x double> %577, <8 x double> poison, <8 x i32> zeroinitializer
  %579 = fmul contract <8 x double> %485, %578
  %580 = fadd contract <8 x double> %574, %579
  %581 = fmul contract <8 x double> %536, zeroinitializer
  %582 = getelementptr inbounds i8, ptr %504, i64 136
  %583 = load double, ptr %582, align 8
  %584 = fcmp contract une double %583, 0.000000e+00
  %585 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %580)
  %586 = select contract i1 %584, <8 x double> %580, <8 x double> %585
  %587 = getelementptr inbounds i8, ptr %504, i64 128
  %588 = load double, ptr %587, align 8
  %589 = fcmp contract une double %588, 0.000000e+00
  br i1 %589, label %590, label %595

590:
  %591 = fmul contract <8 x double> %536, %536
  %592 = fmul contract <8 x double> %558, %558
  %593 = fadd contract <8 x double> %591, %592
  %594 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %593)
  br label %597

595:
  %596 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %536)
  br label %597

597:
  %598 = phi contract <8 x double> [ %594, %590 ], [ %596, %595 ]
  %599 = getelementptr inbounds i8, ptr %504, i64 96
  %600 = load double, ptr %599, align 8
  %601 = insertelement <8 x double> poison, double %600, i64 0
  %602 = shufflevector <8 x double> %601, <8 x double> poison, <8 x i32> zeroinitializer
  %603 = fsub contract <8 x double> %598, %602
  %604 = fcmp contract ogt <8 x double> %603, %581
  %605 = select contract <8 x i1> %604, <8 x double> %603, <8 x double> %581
  %606 = getelementptr inbounds i8, ptr %504, i64 112
  %607 = load double, ptr %606, align 8
  %608 = insertelement <8 x double> poison, double %607, i64 0
  %609 = shufflevector <8 x double> %608, <8 x double> poison, <8 x i32> zeroinitializer
  %610 = fsub contract <8 x double> %586, %609
  %611 = fcmp contract ogt <8 x double> %610, %581
  %612 = select contract <8 x i1> %611, <8 x double> %610, <8 x double> %581
  %613 = fmul contract <8 x double> %605, %605
  %614 = fmul contract <8 x double> %612, %612
  %615 = fadd contract <8 x double> %613, %614
  br i1 %589, label %627, label %616

616:
  %617 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %558)
  %618 = getelementptr inbounds i8, ptr %504, i64 104
  %619 = load double, ptr %618, align 8
  %620 = insertelement <8 x double> poison, double %619, i64 0
  %621 = shufflevector <8 x double> %620, <8 x double> poison, <8 x i32> zeroinitializer
  %622 = fsub contract <8 x double> %617, %621
  %623 = fcmp contract ogt <8 x double> %622, %581
  %624 = select contract <8 x i1> %623, <8 x double> %622, <8 x double> %581
  %625 = fmul contract <8 x double> %624, %624
  %626 = fadd contract <8 x double> %615, %625
  br label %627

627:
  %628 = phi <8 x double> [ %626, %616 ], [ %615, %597 ]
  %629 = fmul contract <8 x double> %515, %515
  %630 = fcmp contract olt <8 x double> %628, %629
  %631 = bitcast <8 x i1> %630 to i8
  %632 = icmp eq i8 %631, 0
  br i1 %632, label %739, label %633

633:
  %634 = load i64, ptr %499, align 8
  %635 = load i64, ptr %500, align 8
  %636 = icmp slt i64 %634, %635
  br i1 %636, label %637, label %639

637:
  %638 = getelementptr inbounds i8, ptr %504, i64 104
  br label %644

639:
  %640 = phi <8 x i64> [ %502, %633 ], [ %736, %732 ]
  %641 = icmp eq <8 x i64> %640, zeroinitializer
  %642 = bitcast <8 x i1> %641 to i8
  %643 = icmp eq i8 %642, 0
  br i1 %643, label %1248, label %739

644:
  %645 = phi <8 x i64> [ %502, %637 ], [ %736, %732 ]
  %646 = phi i64 [ %634, %637 ], [ %737, %732 ]
  %647 = getelementptr inbounds %struct.Sphere.5, ptr %171, i64 %646
  %648 = getelementptr inbounds i8, ptr %647, i64 24
  %649 = load double, ptr %648, align 8
  %650 = fadd contract double %509, %649
  %651 = insertelement <8 x double> poison, double %650, i64 0
  %652 = shufflevector <8 x double> %651, <8 x double> poison, <8 x i32> zeroinitializer
  %653 = fadd contract <8 x double> %495, %652
  %654 = load double, ptr %647, align 8
  %655 = getelementptr inbounds i8, ptr %647, i64 8
  %656 = load double, ptr %655, align 8
  %657 = getelementptr inbounds i8, ptr %647, i64 16
  %658 = load double, ptr %657, align 8
  %659 = insertelement <8 x double> poison, double %654, i64 0
  %660 = shufflevector <8 x double> %659, <8 x double> poison, <8 x i32> zeroinitializer
  %661 = fmul contract <8 x double> %441, %660
  %662 = fadd contract <8 x double> %440, %661
  %663 = insertelement <8 x double> poison, double %656, i64 0
  %664 = shufflevector <8 x double> %663, <8 x double> poison, <8 x i32> zeroinitializer
  %665 = fmul contract <8 x double> %447, %664
  %666 = fadd contract <8 x double> %662, %665
  %667 = insertelement <8 x double> poison, double %658, i64 0
  %668 = shufflevector <8 x double> %667, <8 x double> poison, <8 x i32> zeroinitializer
  %669 = fmul contract <8 x double> %453, %668
  %670 = fadd contract <8 x double> %666, %669
  %671 = fmul contract <8 x double> %461, %660
  %672 = fadd contract <8 x double> %459, %671
  %673 = fmul contract <8 x double> %465, %664
  %674 = fadd contract <8 x double> %672, %673
  %675 = fmul contract <8 x double> %469, %668
  %676 = fadd contract <8 x double> %674, %675
  %677 = fmul contract <8 x double> %475, %660
  %678 = fadd contract <8 x double> %473, %677
  %679 = fmul contract <8 x double> %479, %664
  %680 = fadd contract <8 x double> %678, %679
  %681 = fmul contract <8 x double> %483, %668
  %682 = fadd contract <8 x double> %680, %681
  %683 = fmul contract <8 x double> %522, %670
  %684 = fadd contract <8 x double> %519, %683
  %685 = fmul contract <8 x double> %528, %676
  %686 = fadd contract <8 x double> %685, %684
  %687 = fmul contract <8 x double> %534, %682
  %688 = fadd contract <8 x double> %687, %686
  %689 = fmul contract <8 x double> %544, %670
  %690 = fadd contract <8 x double> %540, %689
  %691 = fmul contract <8 x double> %550, %676
  %692 = fadd contract <8 x double> %691, %690
  %693 = fmul contract <8 x double> %556, %682
  %694 = fadd contract <8 x double> %693, %692
  %695 = fmul contract <8 x double> %566, %670
  %696 = fadd contract <8 x double> %562, %695
  %697 = fmul contract <8 x double> %572, %676
  %698 = fadd contract <8 x double> %697, %696
  %699 = fmul contract <8 x double> %578, %682
  %700 = fadd contract <8 x double> %699, %698
  %701 = fmul contract <8 x double> %688, zeroinitializer
  %702 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %700)
  %703 = select contract i1 %584, <8 x double> %700, <8 x double> %702
  br i1 %589, label %704, label %709

704:
  %705 = fmul contract <8 x double> %688, %688
  %706 = fmul contract <8 x double> %694, %694
  %707 = fadd contract <8 x double> %705, %706
  %708 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %707)
  br label %711

709:
  %710 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %688)
  br label %711

711:
  %712 = phi contract <8 x double> [ %708, %704 ], [ %710, %709 ]
  %713 = fsub contract <8 x double> %712, %602
  %714 = fcmp contract ogt <8 x double> %713, %701
  %715 = select contract <8 x i1> %714, <8 x double> %713, <8 x double> %701
  %716 = fsub contract <8 x double> %703, %609
  %717 = fcmp contract ogt <8 x double> %716, %701
  %718 = select contract <8 x i1> %717, <8 x double> %716, <8 x double> %701
  %719 = fmul contract <8 x double> %715, %715
  %720 = fmul contract <8 x double> %718, %718
  %721 = fadd contract <8 x double> %720, %719
  br i1 %589, label %732, label %722

722:
  %723 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %694)
  %724 = load double, ptr %638, align 8
  %725 = insertelement <8 x double> poison, double %724, i64 0
  %726 = shufflevector <8 x double> %725, <8 x double> poison, <8 x i32> zeroinitializer
  %727 = fsub contract <8 x double> %723, %726
  %728 = fcmp contract ogt <8 x double> %727, %701
  %729 = select contract <8 x i1> %728, <8 x double> %727, <8 x double> %701
  %730 = fmul contract <8 x double> %729, %729
  %731 = fadd contract <8 x double> %721, %730
  br label %732

732:
  %733 = phi <8 x double> [ %731, %722 ], [ %721, %711 ]
  %734 = fmul contract <8 x double> %653, %653
  %735 = fcmp contract olt <8 x double> %733, %734
  %736 = select <8 x i1> %735, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %645
  %737 = add nsw i64 %646, 1
  %738 = icmp eq i64 %737, %635
  br i1 %738, label %639, label %644

739:
  %740 = phi <8 x i64> [ %640, %639 ], [ %502, %627 ], [ %502, %501 ]
  %741 = add nuw nsw i64 %503, 1
  %742 = icmp eq i64 %741, %166
  br i1 %742, label %743, label %501

743:
  %744 = phi <8 x i64> [ %426, %425 ], [ %426, %432 ], [ %740, %739 ]
  %745 = add nuw i64 %427, 1
  %746 = icmp eq i64 %427, %46
  br i1 %746, label %747, label %425

747:
  %748 = phi <8 x i64> [ zeroinitializer, %205 ], [ %744, %743 ]
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %8)
  br i1 %53, label %751, label %749

749:
  %750 = phi <8 x i64> [ %748, %747 ], [ %1245, %1243 ]
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %8)
  br label %1248

751:
  %752 = phi <8 x i64> [ %1245, %1243 ], [ %748, %747 ]
  %753 = phi i64 [ %1244, %1243 ], [ 0, %747 ]
  %754 = phi i64 [ %1246, %1243 ], [ 0, %747 ]
  %755 = getelementptr inbounds %struct.LinkPair, ptr %172, i64 %754
  %756 = load i64, ptr %755, align 8
  %757 = getelementptr inbounds %struct.Sphere.5, ptr %173, i64 %756
  %758 = getelementptr inbounds i8, ptr %755, i64 8
  %759 = load i64, ptr %758, align 8
  %760 = getelementptr inbounds %struct.Sphere.5, ptr %173, i64 %759
  %761 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %756
  %762 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %759
  %763 = getelementptr inbounds [136 x double], ptr %22, i64 0, i64 %754
  %764 = load double, ptr %763, align 8
  %765 = insertelement <8 x double> poison, double %764, i64 0
  %766 = shufflevector <8 x double> %765, <8 x double> poison, <8 x i32> zeroinitializer
  %767 = fmul contract <8 x double> %1265, %766
  %768 = getelementptr inbounds [136 x double], ptr %23, i64 0, i64 %754
  %769 = load double, ptr %768, align 8
  %770 = getelementptr inbounds double, ptr %174, i64 %754
  %771 = load double, ptr %770, align 8
  %772 = fadd contract double %769, %771
  %773 = insertelement <8 x double> poison, double %772, i64 0
  %774 = shufflevector <8 x double> %773, <8 x double> poison, <8 x i32> zeroinitializer
  %775 = fadd contract <8 x double> %767, %774
  %776 = load double, ptr %760, align 8
  %777 = getelementptr inbounds i8, ptr %760, i64 8
  %778 = load double, ptr %777, align 8
  %779 = getelementptr inbounds i8, ptr %760, i64 16
  %780 = load double, ptr %779, align 8
  %781 = getelementptr inbounds i8, ptr %762, i64 576
  %782 = load <8 x double>, ptr %781, align 64
  %783 = load <8 x double>, ptr %762, align 64
  %784 = insertelement <8 x double> poison, double %776, i64 0
  %785 = shufflevector <8 x double> %784, <8 x double> poison, <8 x i32> zeroinitializer
  %786 = fmul contract <8 x double> %785, %783
  %787 = fadd contract <8 x double> %782, %786
  %788 = getelementptr inbounds i8, ptr %762, i64 64
  %789 = load <8 x double>, ptr %788, align 64
  %790 = insertelement <8 x double> poison, double %778, i64 0
  %791 = shufflevector <8 x double> %790, <8 x double> poison, <8 x i32> zeroinitializer
  %792 = fmul contract <8 x double> %791, %789
  %793 = fadd contract <8 x double> %787, %792
  %794 = getelementptr inbounds i8, ptr %762, i64 128
  %795 = load <8 x double>, ptr %794, align 64
  %796 = insertelement <8 x double> poison, double %780, i64 0
  %797 = shufflevector <8 x double> %796, <8 x double> poison, <8 x i32> zeroinitializer
  %798 = fmul contract <8 x double> %797, %795
  %799 = fadd contract <8 x double> %793, %798
  %800 = getelementptr inbounds i8, ptr %762, i64 640
  %801 = load <8 x double>, ptr %800, align 64
  %802 = getelementptr inbounds i8, ptr %762, i64 192
  %803 = load <8 x double>, ptr %802, align 64
  %804 = fmul contract <8 x double> %785, %803
  %805 = fadd contract <8 x double> %801, %804
  %806 = getelementptr inbounds i8, ptr %762, i64 256
  %807 = load <8 x double>, ptr %806, align 64
  %808 = fmul contract <8 x double> %791, %807
  %809 = fadd contract <8 x double> %805, %808
  %810 = getelementptr inbounds i8, ptr %762, i64 320
  %811 = load <8 x double>, ptr %810, align 64
  %812 = fmul contract <8 x double> %797, %811
  %813 = fadd contract <8 x double> %809, %812
  %814 = getelementptr inbounds i8, ptr %762, i64 704
  %815 = load <8 x double>, ptr %814, align 64
  %816 = getelementptr inbounds i8, ptr %762, i64 384
  %817 = load <8 x double>, ptr %816, align 64
  %818 = fmul contract <8 x double> %785, %817
  %819 = fadd contract <8 x double> %815, %818
  %820 = getelementptr inbounds i8, ptr %762, i64 448
  %821 = load <8 x double>, ptr %820, align 64
  %822 = fmul contract <8 x double> %791, %821
  %823 = fadd contract <8 x double> %819, %822
  %824 = getelementptr inbounds i8, ptr %762, i64 512
  %825 = load <8 x double>, ptr %824, align 64
  %826 = fmul contract <8 x double> %797, %825
  %827 = fadd contract <8 x double> %823, %826
  %828 = getelementptr inbounds i8, ptr %757, i64 24
  %829 = load double, ptr %828, align 8
  %830 = getelementptr inbounds i8, ptr %760, i64 24
  %831 = load double, ptr %830, align 8
  %832 = fadd contract double %829, %831
  %833 = insertelement <8 x double> poison, double %832, i64 0
  %834 = shufflevector <8 x double> %833, <8 x double> poison, <8 x i32> zeroinitializer
  %835 = fadd contract <8 x double> %775, %834
  %836 = load double, ptr %757, align 8
  %837 = getelementptr inbounds i8, ptr %757, i64 8
  %838 = load double, ptr %837, align 8
  %839 = getelementptr inbounds i8, ptr %757, i64 16
  %840 = load double, ptr %839, align 8
  %841 = getelementptr inbounds i8, ptr %761, i64 576
  %842 = load <8 x double>, ptr %841, align 64
  %843 = load <8 x double>, ptr %761, align 64
  %844 = insertelement <8 x double> poison, double %836, i64 0
  %845 = shufflevector <8 x double> %844, <8 x double> poison, <8 x i32> zeroinitializer
  %846 = fmul contract <8 x double> %845, %843
  %847 = fadd contract <8 x double> %842, %846
  %848 = getelementptr inbounds i8, ptr %761, i64 64
  %849 = load <8 x double>, ptr %848, align 64
  %850 = insertelement <8 x double> poison, double %838, i64 0
  %851 = shufflevector <8 x double> %850, <8 x double> poison, <8 x i32> zeroinitializer
  %852 = fmul contract <8 x double> %851, %849
  %853 = fadd contract <8 x double> %847, %852
  %854 = getelementptr inbounds i8, ptr %761, i64 128
  %855 = load <8 x double>, ptr %854, align 64
  %856 = insertelement <8 x double> poison, double %840, i64 0
  %857 = shufflevector <8 x double> %856, <8 x double> poison, <8 x i32> zeroinitializer
  %858 = fmul contract <8 x double> %857, %855
  %859 = fadd contract <8 x double> %853, %858
  %860 = getelementptr inbounds i8, ptr %761, i64 640
  %861 = load <8 x double>, ptr %860, align 64
  %862 = getelementptr inbounds i8, ptr %761, i64 192
  %863 = load <8 x double>, ptr %862, align 64
  %864 = fmul contract <8 x double> %845, %863
  %865 = fadd contract <8 x double> %861, %864
  %866 = getelementptr inbounds i8, ptr %761, i64 256
  %867 = load <8 x double>, ptr %866, align 64
  %868 = fmul contract <8 x double> %851, %867
  %869 = fadd contract <8 x double> %865, %868
  %870 = getelementptr inbounds i8, ptr %761, i64 320
  %871 = load <8 x double>, ptr %870, align 64
  %872 = fmul contract <8 x double> %857, %871
  %873 = fadd contract <8 x double> %869, %872
  %874 = getelementptr inbounds i8, ptr %761, i64 704
  %875 = load <8 x double>, ptr %874, align 64
  %876 = getelementptr inbounds i8, ptr %761, i64 384
  %877 = load <8 x double>, ptr %876, align 64
  %878 = fmul contract <8 x double> %845, %877
  %879 = fadd contract <8 x double> %875, %878
  %880 = getelementptr inbounds i8, ptr %761, i64 448
  %881 = load <8 x double>, ptr %880, align 64
  %882 = fmul contract <8 x double> %851, %881
  %883 = fadd contract <8 x double> %879, %882
  %884 = getelementptr inbounds i8, ptr %761, i64 512
  %885 = load <8 x double>, ptr %884, align 64
  %886 = fmul contract <8 x double> %857, %885
  %887 = fadd contract <8 x double> %883, %886
  %888 = fsub contract <8 x double> %859, %799
  %889 = fsub contract <8 x double> %873, %813
  %890 = fsub contract <8 x double> %887, %827
  %891 = fmul contract <8 x double> %888, %888
  %892 = fmul contract <8 x double> %889, %889
  %893 = fadd contract <8 x double> %891, %892
  %894 = fmul contract <8 x double> %890, %890
  %895 = fadd contract <8 x double> %893, %894
  %896 = fmul contract <8 x double> %835, %835
  %897 = fcmp contract olt <8 x double> %895, %896
  %898 = bitcast <8 x i1> %897 to i8
  %899 = icmp eq i8 %898, 0
  br i1 %899, label %1243, label %900

900:
  call void @llvm.lifetime.start.p0(i64 16, ptr nonnull %9)
  store i64 %756, ptr %9, align 16
  store i64 %759, ptr %35, align 8
  br label %907

901:
  %902 = getelementptr inbounds i8, ptr %755, i64 16
  %903 = load i64, ptr %902, align 8
  %904 = getelementptr inbounds i8, ptr %755, i64 24
  %905 = load i64, ptr %904, align 8
  %906 = icmp slt i64 %903, %905
  br i1 %906, label %990, label %988

907:
  %908 = phi i64 [ %753, %900 ], [ %985, %984 ]
  %909 = phi i64 [ 0, %900 ], [ %986, %984 ]
  %910 = getelementptr inbounds i8, ptr %9, i64 %909
  %911 = load i64, ptr %910, align 8
  %912 = shl nuw i64 1, %911
  %913 = and i64 %912, %908
  %914 = icmp eq i64 %913, 0
  br i1 %914, label %915, label %984

915:
  %916 = or i64 %912, %908
  %917 = getelementptr inbounds i64, ptr %175, i64 %911
  %918 = load i64, ptr %917, align 8
  %919 = getelementptr i8, ptr %917, i64 8
  %920 = load i64, ptr %919, align 8
  %921 = icmp slt i64 %918, %920
  br i1 %921, label %922, label %984

922:
  %923 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %911
  %924 = getelementptr inbounds i8, ptr %923, i64 576
  %925 = load <8 x double>, ptr %924, align 64
  %926 = load <8 x double>, ptr %923, align 64
  %927 = getelementptr inbounds i8, ptr %923, i64 64
  %928 = load <8 x double>, ptr %927, align 64
  %929 = getelementptr inbounds i8, ptr %923, i64 128
  %930 = load <8 x double>, ptr %929, align 64
  %931 = getelementptr inbounds i8, ptr %923, i64 640
  %932 = load <8 x double>, ptr %931, align 64
  %933 = getelementptr inbounds i8, ptr %923, i64 192
  %934 = load <8 x double>, ptr %933, align 64
  %935 = getelementptr inbounds i8, ptr %923, i64 256
  %936 = load <8 x double>, ptr %935, align 64
  %937 = getelementptr inbounds i8, ptr %923, i64 320
  %938 = load <8 x double>, ptr %937, align 64
  %939 = getelementptr inbounds i8, ptr %923, i64 704
  %940 = load <8 x double>, ptr %939, align 64
  %941 = getelementptr inbounds i8, ptr %923, i64 384
  %942 = load <8 x double>, ptr %941, align 64
  %943 = getelementptr inbounds i8, ptr %923, i64 448
  %944 = load <8 x double>, ptr %943, align 64
  %945 = getelementptr inbounds i8, ptr %923, i64 512
  %946 = load <8 x double>, ptr %945, align 64
  br label %947

947:
  %948 = phi i64 [ %918, %922 ], [ %982, %947 ]
  %949 = getelementptr inbounds %struct.Part.7, ptr %176, i64 %948
  %950 = load double, ptr %949, align 8
  %951 = getelementptr inbounds i8, ptr %949, i64 8
  %952 = load double, ptr %951, align 8
  %953 = getelementptr inbounds i8, ptr %949, i64 16
  %954 = load double, ptr %953, align 8
  %955 = insertelement <8 x double> poison, double %950, i64 0
  %956 = shufflevector <8 x double> %955, <8 x double> poison, <8 x i32> zeroinitializer
  %957 = fmul contract <8 x double> %926, %956
  %958 = fadd contract <8 x double> %925, %957
  %959 = insertelement <8 x double> poison, double %952, i64 0
  %960 = shufflevector <8 x double> %959, <8 x double> poison, <8 x i32> zeroinitializer
  %961 = fmul contract <8 x double> %928, %960
  %962 = fadd contract <8 x double> %958, %961
  %963 = insertelement <8 x double> poison, double %954, i64 0
  %964 = shufflevector <8 x double> %963, <8 x double> poison, <8 x i32> zeroinitializer
  %965 = fmul contract <8 x double> %930, %964
  %966 = fadd contract <8 x double> %962, %965
  %967 = fmul contract <8 x double> %934, %956
  %968 = fadd contract <8 x double> %932, %967
  %969 = fmul contract <8 x double> %936, %960
  %970 = fadd contract <8 x double> %968, %969
  %971 = fmul contract <8 x double> %938, %964
  %972 = fadd contract <8 x double> %970, %971
  %973 = fmul contract <8 x double> %942, %956
  %974 = fadd contract <8 x double> %940, %973
  %975 = fmul contract <8 x double> %944, %960
  %976 = fadd contract <8 x double> %974, %975
  %977 = fmul contract <8 x double> %946, %964
  %978 = fadd contract <8 x double> %976, %977
  %979 = getelementptr inbounds [192 x %struct.Point.4], ptr %8, i64 0, i64 %948
  store <8 x double> %966, ptr %979, align 64
  %980 = getelementptr inbounds i8, ptr %979, i64 64
  store <8 x double> %972, ptr %980, align 64
  %981 = getelementptr inbounds i8, ptr %979, i64 128
  store <8 x double> %978, ptr %981, align 64
  %982 = add nsw i64 %948, 1
  %983 = icmp eq i64 %982, %920
  br i1 %983, label %984, label %947

984:
  %985 = phi i64 [ %908, %907 ], [ %916, %915 ], [ %916, %947 ]
  %986 = add nuw nsw i64 %909, 8
  %987 = icmp eq i64 %986, 16
  br i1 %987, label %901, label %907

988:
  %989 = phi <8 x i64> [ %752, %901 ], [ %1240, %1237 ]
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %9)
  br label %1243

990:
  %991 = phi <8 x i64> [ %1240, %1237 ], [ %752, %901 ]
  %992 = phi i64 [ %1241, %1237 ], [ %903, %901 ]
  %993 = phi i1 [ %1238, %1237 ], [ false, %901 ]
  %994 = phi i64 [ %1239, %1237 ], [ -1, %901 ]
  %995 = getelementptr inbounds %struct.PartPair, ptr %177, i64 %992
  %996 = load i64, ptr %995, align 8
  %997 = getelementptr inbounds %struct.Part.7, ptr %176, i64 %996
  %998 = getelementptr inbounds i8, ptr %995, i64 8
  %999 = load i64, ptr %998, align 8
  %1000 = getelementptr inbounds %struct.Part.7, ptr %176, i64 %999
  %1001 = icmp eq i64 %996, %994
  br i1 %1001, label %1027, label %1002

1002:
  %1003 = getelementptr inbounds i8, ptr %997, i64 56
  %1004 = load double, ptr %1003, align 8
  %1005 = fadd contract double %831, %1004
  %1006 = insertelement <8 x double> poison, double %1005, i64 0
  %1007 = shufflevector <8 x double> %1006, <8 x double> poison, <8 x i32> zeroinitializer
  %1008 = fadd contract <8 x double> %775, %1007
  %1009 = getelementptr inbounds [192 x %struct.Point.4], ptr %8, i64 0, i64 %996
  %1010 = load <8 x double>, ptr %1009, align 64
  %1011 = fsub contract <8 x double> %1010, %799
  %1012 = getelementptr inbounds i8, ptr %1009, i64 64
  %1013 = load <8 x double>, ptr %1012, align 64
  %1014 = fsub contract <8 x double> %1013, %813
  %1015 = getelementptr inbounds i8, ptr %1009, i64 128
  %1016 = load <8 x double>, ptr %1015, align 64
  %1017 = fsub contract <8 x double> %1016, %827
  %1018 = fmul contract <8 x double> %1011, %1011
  %1019 = fmul contract <8 x double> %1014, %1014
  %1020 = fadd contract <8 x double> %1018, %1019
  %1021 = fmul contract <8 x double> %1017, %1017
  %1022 = fadd contract <8 x double> %1020, %1021
  %1023 = fmul contract <8 x double> %1008, %1008
  %1024 = fcmp contract olt <8 x double> %1022, %1023
  %1025 = bitcast <8 x i1> %1024 to i8
  %1026 = icmp eq i8 %1025, 0
  br i1 %1026, label %1237, label %1037

1027:
  br i1 %993, label %1028, label %1237

1028:
  %1029 = getelementptr inbounds i8, ptr %997, i64 56
  %1030 = load double, ptr %1029, align 8
  %1031 = getelementptr inbounds [192 x %struct.Point.4], ptr %8, i64 0, i64 %994
  %1032 = load <8 x double>, ptr %1031, align 64
  %1033 = getelementptr inbounds i8, ptr %1031, i64 64
  %1034 = load <8 x double>, ptr %1033, align 64
  %1035 = getelementptr inbounds i8, ptr %1031, i64 128
  %1036 = load <8 x double>, ptr %1035, align 64
  br label %1037

1037:
  %1038 = phi <8 x double> [ %1016, %1002 ], [ %1036, %1028 ]
  %1039 = phi <8 x double> [ %1013, %1002 ], [ %1034, %1028 ]
  %1040 = phi <8 x double> [ %1010, %1002 ], [ %1032, %1028 ]
  %1041 = phi double [ %1004, %1002 ], [ %1030, %1028 ]
  %1042 = phi i64 [ %996, %1002 ], [ %994, %1028 ]
  %1043 = getelementptr inbounds i8, ptr %1000, i64 56
  %1044 = load double, ptr %1043, align 8
  %1045 = fadd contract double %1041, %1044
  %1046 = insertelement <8 x double> poison, double %1045, i64 0
  %1047 = shufflevector <8 x double> %1046, <8 x double> poison, <8 x i32> zeroinitializer
  %1048 = fadd contract <8 x double> %775, %1047
  %1049 = getelementptr inbounds [192 x %struct.Point.4], ptr %8, i64 0, i64 %999
  %1050 = load <8 x double>, ptr %1049, align 64
  %1051 = fsub contract <8 x double> %1040, %1050
  %1052 = getelementptr inbounds i8, ptr %1049, i64 64
  %1053 = load <8 x double>, ptr %1052, align 64
  %1054 = fsub contract <8 x double> %1039, %1053
  %1055 = getelementptr inbounds i8, ptr %1049, i64 128
  %1056 = load <8 x double>, ptr %1055, align 64
  %1057 = fsub contract <8 x double> %1038, %1056
  %1058 = fmul contract <8 x double> %1051, %1051
  %1059 = fmul contract <8 x double> %1054, %1054
  %1060 = fadd contract <8 x double> %1058, %1059
  %1061 = fmul contract <8 x double> %1057, %1057
  %1062 = fadd contract <8 x double> %1060, %1061
  %1063 = fmul contract <8 x double> %1048, %1048
  %1064 = fcmp contract olt <8 x double> %1062, %1063
  %1065 = bitcast <8 x i1> %1064 to i8
  %1066 = icmp eq i8 %1065, 0
  br i1 %1066, label %1237, label %1067

1067:
  %1068 = getelementptr inbounds i8, ptr %997, i64 48
  %1069 = load double, ptr %1068, align 8
  %1070 = getelementptr inbounds i8, ptr %1000, i64 48
  %1071 = load double, ptr %1070, align 8
  %1072 = fadd contract double %1069, %1071
  %1073 = insertelement <8 x double> poison, double %1072, i64 0
  %1074 = shufflevector <8 x double> %1073, <8 x double> poison, <8 x i32> zeroinitializer
  %1075 = fadd contract <8 x double> %775, %1074
  %1076 = getelementptr inbounds i8, ptr %997, i64 24
  %1077 = load double, ptr %1076, align 8
  %1078 = fmul contract double %1077, %1077
  %1079 = getelementptr inbounds i8, ptr %997, i64 32
  %1080 = load double, ptr %1079, align 8
  %1081 = fmul contract double %1080, %1080
  %1082 = fadd contract double %1078, %1081
  %1083 = getelementptr inbounds i8, ptr %997, i64 40
  %1084 = load double, ptr %1083, align 8
  %1085 = fmul contract double %1084, %1084
  %1086 = fadd contract double %1082, %1085
  %1087 = getelementptr inbounds i8, ptr %1000, i64 24
  %1088 = load double, ptr %1087, align 8
  %1089 = fmul contract double %1088, %1088
  %1090 = getelementptr inbounds i8, ptr %1000, i64 32
  %1091 = load double, ptr %1090, align 8
  %1092 = fmul contract double %1091, %1091
  %1093 = fadd contract double %1089, %1092
  %1094 = getelementptr inbounds i8, ptr %1000, i64 40
  %1095 = load double, ptr %1094, align 8
  %1096 = fmul contract double %1095, %1095
  %1097 = fadd contract double %1093, %1096
  %1098 = fcmp contract oeq double %1086, 0.000000e+00
  %1099 = fcmp contract oeq double %1097, 0.000000e+00
  %1100 = select i1 %1098, i1 %1099, i1 false
  br i1 %1100, label %1232, label %1101

1101:
  %1102 = fmul contract <8 x double> %1040, zeroinitializer
  %1103 = fadd contract <8 x double> %1102, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %1104 = insertelement <8 x double> poison, double %1077, i64 0
  %1105 = shufflevector <8 x double> %1104, <8 x double> poison, <8 x i32> zeroinitializer
  %1106 = fmul contract <8 x double> %843, %1105
  %1107 = insertelement <8 x double> poison, double %1080, i64 0
  %1108 = shufflevector <8 x double> %1107, <8 x double> poison, <8 x i32> zeroinitializer
  %1109 = fmul contract <8 x double> %849, %1108
  %1110 = fadd contract <8 x double> %1106, %1109
  %1111 = insertelement <8 x double> poison, double %1084, i64 0
  %1112 = shufflevector <8 x double> %1111, <8 x double> poison, <8 x i32> zeroinitializer
  %1113 = fmul contract <8 x double> %855, %1112
  %1114 = fadd contract <8 x double> %1110, %1113
  %1115 = fmul contract <8 x double> %863, %1105
  %1116 = fmul contract <8 x double> %867, %1108
  %1117 = fadd contract <8 x double> %1115, %1116
  %1118 = fmul contract <8 x double> %871, %1112
  %1119 = fadd contract <8 x double> %1117, %1118
  %1120 = fmul contract <8 x double> %877, %1105
  %1121 = fmul contract <8 x double> %881, %1108
  %1122 = fadd contract <8 x double> %1120, %1121
  %1123 = fmul contract <8 x double> %885, %1112
  %1124 = fadd contract <8 x double> %1122, %1123
  %1125 = insertelement <8 x double> poison, double %1088, i64 0
  %1126 = shufflevector <8 x double> %1125, <8 x double> poison, <8 x i32> zeroinitializer
  %1127 = fmul contract <8 x double> %783, %1126
  %1128 = insertelement <8 x double> poison, double %1091, i64 0
  %1129 = shufflevector <8 x double> %1128, <8 x double> poison, <8 x i32> zeroinitializer
  %1130 = fmul contract <8 x double> %789, %1129
  %1131 = fadd contract <8 x double> %1127, %1130
  %1132 = insertelement <8 x double> poison, double %1095, i64 0
  %1133 = shufflevector <8 x double> %1132, <8 x double> poison, <8 x i32> zeroinitializer
  %1134 = fmul contract <8 x double> %795, %1133
  %1135 = fadd contract <8 x double> %1131, %1134
  %1136 = fmul contract <8 x double> %803, %1126
  %1137 = fmul contract <8 x double> %807, %1129
  %1138 = fadd contract <8 x double> %1136, %1137
  %1139 = fmul contract <8 x double> %811, %1133
  %1140 = fadd contract <8 x double> %1138, %1139
  %1141 = fmul contract <8 x double> %817, %1126
  %1142 = fmul contract <8 x double> %821, %1129
  %1143 = fadd contract <8 x double> %1141, %1142
  %1144 = fmul contract <8 x double> %825, %1133
  %1145 = fadd contract <8 x double> %1143, %1144
  %1146 = fcmp contract ogt double %1086, 0.000000e+00
  %1147 = fdiv contract double 1.000000e+00, %1086
  %1148 = select contract i1 %1146, double %1147, double 0.000000e+00
  %1149 = fcmp contract ogt double %1097, 0.000000e+00
  %1150 = fdiv contract double 1.000000e+00, %1097
  %1151 = select contract i1 %1149, double %1150, double 0.000000e+00
  %1152 = fmul contract <8 x double> %1114, %1135
  %1153 = fmul contract <8 x double> %1119, %1140
  %1154 = fadd contract <8 x double> %1152, %1153
  %1155 = fmul contract <8 x double> %1124, %1145
  %1156 = fadd contract <8 x double> %1155, %1154
  %1157 = fmul contract <8 x double> %1051, %1114
  %1158 = fmul contract <8 x double> %1054, %1119
  %1159 = fadd contract <8 x double> %1157, %1158
  %1160 = fmul contract <8 x double> %1057, %1124
  %1161 = fadd contract <8 x double> %1160, %1159
  %1162 = fmul contract <8 x double> %1051, %1135
  %1163 = fmul contract <8 x double> %1054, %1140
  %1164 = fadd contract <8 x double> %1162, %1163
  %1165 = fmul contract <8 x double> %1057, %1145
  %1166 = fadd contract <8 x double> %1165, %1164
  %1167 = fmul contract double %1086, %1097
  %1168 = insertelement <8 x double> poison, double %1167, i64 0
  %1169 = shufflevector <8 x double> %1168, <8 x double> poison, <8 x i32> zeroinitializer
  %1170 = fmul contract <8 x double> %1156, %1156
  %1171 = fsub contract <8 x double> %1169, %1170
  %1172 = fmul contract double %1086, 0x3E7AD7F29ABCAF48
  %1173 = fmul contract double %1172, %1097
  %1174 = insertelement <8 x double> poison, double %1173, i64 0
  %1175 = shufflevector <8 x double> %1174, <8 x double> poison, <8 x i32> zeroinitializer
  %1176 = fcmp contract ogt <8 x double> %1171, %1175
  %1177 = fmul contract <8 x double> %1156, %1166
  %1178 = insertelement <8 x double> poison, double %1097, i64 0
  %1179 = shufflevector <8 x double> %1178, <8 x double> poison, <8 x i32> zeroinitializer
  %1180 = fmul contract <8 x double> %1179, %1161
  %1181 = fsub contract <8 x double> %1177, %1180
  %1182 = select contract <8 x i1> %1176, <8 x double> %1171, <8 x double> %1103
  %1183 = fdiv contract <8 x double> %1181, %1182
  %1184 = fneg contract <8 x double> %1103
  %1185 = fcmp contract ogt <8 x double> %1183, %1184
  %1186 = select contract <8 x i1> %1185, <8 x double> %1183, <8 x double> %1184
  %1187 = fcmp contract olt <8 x double> %1186, %1103
  %1188 = select contract <8 x i1> %1187, <8 x double> %1186, <8 x double> %1103
  %1189 = select contract <8 x i1> %1176, <8 x double> %1188, <8 x double> %1184
  %1190 = fmul contract <8 x double> %1156, %1189
  %1191 = fadd contract <8 x double> %1166, %1190
  %1192 = insertelement <8 x double> poison, double %1151, i64 0
  %1193 = shufflevector <8 x double> %1192, <8 x double> poison, <8 x i32> zeroinitializer
  %1194 = fmul contract <8 x double> %1193, %1191
  %1195 = fcmp contract ogt <8 x double> %1194, %1184
  %1196 = select contract <8 x i1> %1195, <8 x double> %1194, <8 x double> %1184
  %1197 = fcmp contract olt <8 x double> %1196, %1103
  %1198 = select contract <8 x i1> %1197, <8 x double> %1196, <8 x double> %1103
  %1199 = fmul contract <8 x double> %1156, %1198
  %1200 = fsub contract <8 x double> %1199, %1161
  %1201 = insertelement <8 x double> poison, double %1148, i64 0
  %1202 = shufflevector <8 x double> %1201, <8 x double> poison, <8 x i32> zeroinitializer
  %1203 = fmul contract <8 x double> %1202, %1200
  %1204 = fcmp contract ogt <8 x double> %1203, %1184
  %1205 = select contract <8 x i1> %1204, <8 x double> %1203, <8 x double> %1184
  %1206 = fcmp contract olt <8 x double> %1205, %1103
  %1207 = select contract <8 x i1> %1206, <8 x double> %1205, <8 x double> %1103
  %1208 = fmul contract <8 x double> %1156, %1207
  %1209 = fadd contract <8 x double> %1166, %1208
  %1210 = fmul contract <8 x double> %1193, %1209
  %1211 = fcmp contract ogt <8 x double> %1210, %1184
  %1212 = select contract <8 x i1> %1211, <8 x double> %1210, <8 x double> %1184
  %1213 = fcmp contract olt <8 x double> %1212, %1103
  %1214 = select contract <8 x i1> %1213, <8 x double> %1212, <8 x double> %1103
  %1215 = fmul contract <8 x double> %1114, %1207
  %1216 = fadd contract <8 x double> %1051, %1215
  %1217 = fmul contract <8 x double> %1135, %1214
  %1218 = fsub contract <8 x double> %1216, %1217
  %1219 = fmul contract <8 x double> %1119, %1207
  %1220 = fadd contract <8 x double> %1054, %1219
  %1221 = fmul contract <8 x double> %1140, %1214
  %1222 = fsub contract <8 x double> %1220, %1221
  %1223 = fmul contract <8 x double> %1124, %1207
  %1224 = fadd contract <8 x double> %1057, %1223
  %1225 = fmul contract <8 x double> %1145, %1214
  %1226 = fsub contract <8 x double> %1224, %1225
  %1227 = fmul contract <8 x double> %1218, %1218
  %1228 = fmul contract <8 x double> %1222, %1222
  %1229 = fadd contract <8 x double> %1227, %1228
  %1230 = fmul contract <8 x double> %1226, %1226
  %1231 = fadd contract <8 x double> %1230, %1229
  br label %1232

1232:
  %1233 = phi <8 x double> [ %1231, %1101 ], [ %1062, %1067 ]
  %1234 = fmul contract <8 x double> %1075, %1075
  %1235 = fcmp contract olt <8 x double> %1233, %1234
  %1236 = select <8 x i1> %1235, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %991
  br label %1237

1237:
  %1238 = phi i1 [ true, %1232 ], [ false, %1027 ], [ true, %1037 ], [ false, %1002 ]
  %1239 = phi i64 [ %1042, %1232 ], [ %994, %1027 ], [ %1042, %1037 ], [ %996, %1002 ]
  %1240 = phi <8 x i64> [ %1236, %1232 ], [ %991, %1027 ], [ %991, %1037 ], [ %991, %1002 ]
  %1241 = add nsw i64 %992, 1
  %1242 = icmp eq i64 %1241, %905
  br i1 %1242, label %988, label %990

1243:
  %1244 = phi i64 [ %985, %988 ], [ %753, %751 ]
  %1245 = phi <8 x i64> [ %989, %988 ], [ %752, %751 ]
  %1246 = add nuw nsw i64 %754, 1
  %1247 = icmp eq i64 %1246, %52
  br i1 %1247, label %749, label %751

1248:
  %1249 = phi <8 x i64> [ %750, %749 ], [ %640, %639 ]
  %1250 = icmp sgt i64 %189, 0
  br i1 %1250, label %1268, label %1298

1251:
  %1252 = phi <8 x double> [ %190, %188 ], [ %1262, %1251 ]
  %1253 = phi <8 x double> [ %191, %188 ], [ %1265, %1251 ]
  %1254 = phi i64 [ 0, %188 ], [ %1266, %1251 ]
  %1255 = icmp sgt i64 %189, %1254
  %1256 = xor i64 %1254, -1
  %1257 = select i1 %1255, i64 %1256, i64 -1
  %1258 = add i64 %1257, %189
  %1259 = getelementptr inbounds [4096 x %struct.Piece], ptr %12, i64 0, i64 %1258
  %1260 = getelementptr inbounds [8 x %struct.Piece], ptr %14, i64 0, i64 %1254
  call void @llvm.memcpy.p0.p0.i64(ptr noundef nonnull align 16 dereferenceable(16) %1260, ptr noundef nonnull align 16 dereferenceable(16) %1259, i64 16, i1 false)
  %1261 = load double, ptr %1260, align 16
  %1262 = insertelement <8 x double> %1252, double %1261, i64 %1254
  %1263 = getelementptr inbounds i8, ptr %1260, i64 8
  %1264 = load double, ptr %1263, align 8
  %1265 = insertelement <8 x double> %1253, double %1264, i64 %1254
  %1266 = add nuw nsw i64 %1254, 1
  %1267 = icmp eq i64 %1266, 8
  br i1 %1267, label %192, label %1251

1268:
  %1269 = phi i64 [ %1295, %1294 ], [ %207, %1248 ]
  %1270 = phi i64 [ %1296, %1294 ], [ 0, %1248 ]
  %1271 = extractelement <8 x i64> %1249, i64 %1270
  %1272 = icmp eq i64 %1271, 0
  br i1 %1272, label %1294, label %1273

1273:
  %1274 = getelementptr inbounds [8 x %struct.Piece], ptr %14, i64 0, i64 %1270
  %1275 = getelementptr inbounds i8, ptr %1274, i64 8
  %1276 = load double, ptr %1275, align 8
  %1277 = fmul contract double %161, %1276
  %1278 = fmul contract double %1277, 2.000000e+00
  %1279 = fcmp contract olt double %1278, %5
  %1280 = icmp sgt i64 %1269, 4094
  %1281 = select i1 %1279, i1 true, i1 %1280
  br i1 %1281, label %1282, label %1283

1282:
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %14)
  br label %1301

1283:
  %1284 = fmul contract double %1276, 5.000000e-01
  %1285 = load double, ptr %1274, align 16
  %1286 = fsub contract double %1285, %1284
  %1287 = add nsw i64 %1269, 1
  %1288 = getelementptr inbounds [4096 x %struct.Piece], ptr %12, i64 0, i64 %1269
  store double %1286, ptr %1288, align 16
  %1289 = getelementptr inbounds i8, ptr %1288, i64 8
  store double %1284, ptr %1289, align 8
  %1290 = fadd contract double %1284, %1285
  %1291 = add nsw i64 %1269, 2
  %1292 = getelementptr inbounds [4096 x %struct.Piece], ptr %12, i64 0, i64 %1287
  store double %1290, ptr %1292, align 16
  %1293 = getelementptr inbounds i8, ptr %1292, i64 8
  store double %1284, ptr %1293, align 8
  br label %1294

1294:
  %1295 = phi i64 [ %1269, %1268 ], [ %1291, %1283 ]
  %1296 = add nuw nsw i64 %1270, 1
  %1297 = icmp eq i64 %1296, %206
  br i1 %1297, label %1298, label %1268

1298:
  %1299 = phi i64 [ %207, %1248 ], [ %1295, %1294 ]
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %14)
  %1300 = icmp eq i64 %1299, 0
  br i1 %1300, label %1301, label %188

1301:
  %1302 = phi i8 [ 0, %1282 ], [ 1, %1298 ]
  call void @llvm.lifetime.end.p0(i64 13056, ptr nonnull %13)
  call void @llvm.lifetime.end.p0(i64 65536, ptr nonnull %12)
  call void @llvm.lifetime.end.p0(i64 2448, ptr nonnull %11)
  %1303 = getelementptr inbounds i8, ptr %6, i64 %41
  store i8 %1302, ptr %1303, align 1
  %1304 = add nuw nsw i64 %41, 1
  %1305 = icmp eq i64 %1304, %4
  br i1 %1305, label %39, label %40
}

define i64 @search_route(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3, i64 noundef %4, i64 noundef %5, ptr nocapture noundef %6, ptr nocapture noundef writeonly %7) {
  %9 = alloca <16 x float>, align 64
  %10 = alloca <16 x float>, align 64
  %11 = alloca <16 x float>, align 64
  %12 = alloca <16 x float>, align 64
  %13 = alloca [2 x %struct.Tree], align 16
  %14 = alloca %struct.Random, align 8
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %14)
  store i64 %5, ptr %14, align 8
  %15 = load <16 x float>, ptr %2, align 4
  call void @llvm.lifetime.start.p0(i64 48, ptr nonnull %13)
  %16 = getelementptr inbounds i8, ptr %1, i64 64
  %17 = load ptr, ptr %16, align 8
  store ptr %17, ptr %13, align 16
  %18 = getelementptr inbounds i8, ptr %13, i64 8
  %19 = getelementptr inbounds i8, ptr %1, i64 72
  %20 = load ptr, ptr %19, align 8
  store ptr %20, ptr %18, align 8
  %21 = getelementptr inbounds i8, ptr %13, i64 16
  %22 = getelementptr inbounds i8, ptr %13, i64 24
  %23 = getelementptr inbounds i8, ptr %1, i64 40
  %24 = load i64, ptr %23, align 8
  %25 = getelementptr inbounds <16 x float>, ptr %17, i64 %24
  store ptr %25, ptr %22, align 8
  %26 = getelementptr inbounds i8, ptr %13, i64 32
  %27 = getelementptr inbounds i32, ptr %20, i64 %24
  store ptr %27, ptr %26, align 16
  %28 = getelementptr inbounds i8, ptr %13, i64 40
  store i64 0, ptr %28, align 8
  store <16 x float> %15, ptr %17, align 4
  store i64 1, ptr %21, align 16
  store i32 -1, ptr %20, align 4
  %29 = icmp sgt i64 %4, 0
  br i1 %29, label %47, label %31

30:
  store i64 %4, ptr %28, align 8
  br label %31

31:
  %32 = load ptr, ptr %1, align 8
  %33 = load <16 x float>, ptr %32, align 4
  %34 = getelementptr inbounds i8, ptr %1, i64 8
  %35 = load ptr, ptr %34, align 8
  %36 = load <16 x float>, ptr %35, align 4
  %37 = getelementptr inbounds i8, ptr %1, i64 48
  %38 = load i64, ptr %37, align 8
  %39 = icmp sgt i64 %38, 0
  br i1 %39, label %40, label %433

40:
  %41 = getelementptr inbounds i8, ptr %1, i64 24
  %42 = getelementptr inbounds i8, ptr %1, i64 16
  %43 = getelementptr inbounds i8, ptr %1, i64 32
  %44 = getelementptr inbounds i8, ptr %1, i64 80
  %45 = getelementptr inbounds i8, ptr %1, i64 84
  %46 = getelementptr inbounds i8, ptr %1, i64 88
  br label %55

47:
  %48 = phi i64 [ %52, %47 ], [ 0, %8 ]
  %49 = getelementptr inbounds <16 x float>, ptr %3, i64 %48
  %50 = load <16 x float>, ptr %49, align 4
  %51 = getelementptr inbounds <16 x float>, ptr %25, i64 %48
  store <16 x float> %50, ptr %51, align 4
  %52 = add nuw nsw i64 %48, 1
  %53 = getelementptr inbounds i32, ptr %27, i64 %48
  store i32 -1, ptr %53, align 4
  %54 = icmp eq i64 %52, %4
  br i1 %54, label %30, label %47

55:
  %56 = phi i64 [ %38, %40 ], [ %430, %429 ]
  %57 = phi i64 [ %5, %40 ], [ %83, %429 ]
  %58 = phi i64 [ 0, %40 ], [ %431, %429 ]
  %59 = load i64, ptr %21, align 16
  %60 = load i64, ptr %28, align 8
  %61 = icmp sgt i64 %59, %60
  %62 = zext i1 %61 to i64
  %63 = getelementptr inbounds [2 x %struct.Tree], ptr %13, i64 0, i64 %62
  %64 = xor i1 %61, true
  %65 = zext i1 %64 to i64
  %66 = getelementptr inbounds [2 x %struct.Tree], ptr %13, i64 0, i64 %65
  %67 = getelementptr inbounds i8, ptr %63, i64 16
  %68 = load i64, ptr %67, align 8
  %69 = load i64, ptr %23, align 8
  %70 = icmp slt i64 %68, %69
  br i1 %70, label %71, label %433

71:
  %72 = getelementptr inbounds i8, ptr %66, i64 16
  %73 = load i64, ptr %72, align 8
  %74 = icmp slt i64 %73, %69
  br i1 %74, label %75, label %433

75:
  %76 = load i64, ptr %0, align 8
  %77 = icmp sgt i64 %76, 0
  br i1 %77, label %78, label %82

78:
  %79 = mul i64 %76, -7046029254386353131
  br label %185

80:
  %81 = add i64 %79, %57
  br label %82

82:
  %83 = phi i64 [ %57, %75 ], [ %81, %80 ]
  %84 = phi <16 x float> [ %33, %75 ], [ %205, %80 ]
  %85 = load ptr, ptr %63, align 8
  %86 = load ptr, ptr %41, align 8
  %87 = load <16 x float>, ptr %86, align 4
  %88 = fcmp contract oeq <16 x float> %87, zeroinitializer
  %89 = select contract <16 x i1> %88, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %90 = fadd contract <16 x float> %87, %89
  %91 = load ptr, ptr %42, align 8
  %92 = load <16 x float>, ptr %91, align 4
  %93 = icmp sgt i64 %68, 1
  br i1 %93, label %94, label %149

94:
  %95 = load <16 x float>, ptr %85, align 4
  %96 = fsub contract <16 x float> %84, %95
  %97 = fdiv contract <16 x float> %96, %90
  %98 = fadd contract <16 x float> %97, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %99 = fadd contract <16 x float> %98, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %100 = fmul contract <16 x float> %87, %99
  %101 = fsub contract <16 x float> %96, %100
  %102 = fmul contract <16 x float> %92, %101
  %103 = fmul contract <16 x float> %102, %102
  %104 = shufflevector <16 x float> %103, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %105 = shufflevector <16 x float> %103, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %106 = fadd contract <8 x float> %104, %105
  %107 = shufflevector <8 x float> %106, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %108 = shufflevector <8 x float> %106, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %109 = fadd contract <4 x float> %107, %108
  %110 = shufflevector <4 x float> %109, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %111 = fadd contract <4 x float> %109, %110
  %112 = shufflevector <4 x float> %109, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %113 = fadd contract <4 x float> %109, %112
  %114 = shufflevector <4 x float> %113, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %115 = fadd contract <4 x float> %111, %114
  %116 = extractelement <4 x float> %115, i64 0
  br label %117

117:
  %118 = phi i64 [ %146, %117 ], [ 0, %94 ]
  %119 = phi i64 [ %147, %117 ], [ 1, %94 ]
  %120 = phi float [ %145, %117 ], [ %116, %94 ]
  %121 = getelementptr inbounds <16 x float>, ptr %85, i64 %119
  %122 = load <16 x float>, ptr %121, align 4
  %123 = fsub contract <16 x float> %84, %122
  %124 = fdiv contract <16 x float> %123, %90
  %125 = fadd contract <16 x float> %124, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %126 = fadd contract <16 x float> %125, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %127 = fmul contract <16 x float> %87, %126
  %128 = fsub contract <16 x float> %123, %127
  %129 = fmul contract <16 x float> %92, %128
  %130 = fmul contract <16 x float> %129, %129
  %131 = shufflevector <16 x float> %130, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %132 = shufflevector <16 x float> %130, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %133 = fadd contract <8 x float> %131, %132
  %134 = shufflevector <8 x float> %133, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %135 = shufflevector <8 x float> %133, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %136 = fadd contract <4 x float> %134, %135
  %137 = shufflevector <4 x float> %136, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %138 = fadd contract <4 x float> %136, %137
  %139 = shufflevector <4 x float> %136, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %140 = fadd contract <4 x float> %136, %139
  %141 = shufflevector <4 x float> %140, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %142 = fadd contract <4 x float> %138, %141
  %143 = extractelement <4 x float> %142, i64 0
  %144 = fcmp contract olt float %143, %120
  %145 = select i1 %144, float %143, float %120
  %146 = select i1 %144, i64 %119, i64 %118
  %147 = add nuw nsw i64 %119, 1
  %148 = icmp eq i64 %147, %68
  br i1 %148, label %149, label %117

149:
  %150 = phi i64 [ 0, %82 ], [ %146, %117 ]
  %151 = getelementptr inbounds <16 x float>, ptr %85, i64 %150
  %152 = load <16 x float>, ptr %151, align 4
  %153 = fsub contract <16 x float> %84, %152
  %154 = fdiv contract <16 x float> %153, %90
  %155 = fadd contract <16 x float> %154, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %156 = fadd contract <16 x float> %155, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %157 = fmul contract <16 x float> %87, %156
  %158 = fsub contract <16 x float> %153, %157
  %159 = load i64, ptr %43, align 8
  %160 = icmp eq i64 %159, 0
  %161 = fmul contract <16 x float> %92, %158
  br i1 %160, label %162, label %178

162:
  %163 = fmul contract <16 x float> %161, %161
  %164 = shufflevector <16 x float> %163, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %165 = shufflevector <16 x float> %163, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %166 = fadd contract <8 x float> %164, %165
  %167 = shufflevector <8 x float> %166, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %168 = shufflevector <8 x float> %166, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %169 = fadd contract <4 x float> %167, %168
  %170 = shufflevector <4 x float> %169, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %171 = fadd contract <4 x float> %169, %170
  %172 = shufflevector <4 x float> %169, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %173 = fadd contract <4 x float> %169, %172
  %174 = shufflevector <4 x float> %173, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %175 = fadd contract <4 x float> %171, %174
  %176 = extractelement <4 x float> %175, i64 0
  %177 = tail call contract float @llvm.sqrt.f32(float %176)
  br label %181

178:
  %179 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %161)
  %180 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %179)
  br label %181

181:
  %182 = phi float [ %180, %178 ], [ %177, %162 ]
  %183 = load float, ptr %44, align 8
  %184 = fcmp contract ogt float %182, %183
  br i1 %184, label %208, label %213

185:
  %186 = phi i64 [ %192, %185 ], [ %57, %78 ]
  %187 = phi <16 x float> [ %205, %185 ], [ %33, %78 ]
  %188 = phi i64 [ %206, %185 ], [ 0, %78 ]
  %189 = extractelement <16 x float> %36, i64 %188
  %190 = extractelement <16 x float> %33, i64 %188
  %191 = fsub contract float %189, %190
  %192 = add i64 %186, -7046029254386353131
  %193 = lshr i64 %192, 30
  %194 = xor i64 %193, %192
  %195 = mul i64 %194, -4658895280553007687
  %196 = lshr i64 %195, 27
  %197 = xor i64 %196, %195
  %198 = mul i64 %197, -7723592293110705685
  %199 = lshr i64 %198, 40
  %200 = uitofp nneg i64 %199 to float
  %201 = fmul contract float %200, 0x3E70000000000000
  %202 = fmul contract float %191, %201
  %203 = extractelement <16 x float> %187, i64 %188
  %204 = fadd contract float %203, %202
  %205 = insertelement <16 x float> %187, float %204, i64 %188
  %206 = add nuw nsw i64 %188, 1
  %207 = icmp eq i64 %206, %76
  br i1 %207, label %80, label %185

208:
  %209 = fdiv contract float %183, %182
  %210 = insertelement <16 x float> poison, float %209, i64 0
  %211 = shufflevector <16 x float> %210, <16 x float> poison, <16 x i32> zeroinitializer
  %212 = fmul contract <16 x float> %158, %211
  br label %213

213:
  %214 = phi <16 x float> [ %212, %208 ], [ %158, %181 ]
  %215 = fcmp contract oeq float %182, 0.000000e+00
  br i1 %215, label %429, label %216

216:
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %9)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %10)
  store <16 x float> %152, ptr %9, align 64
  store <16 x float> %214, ptr %10, align 64
  %217 = load float, ptr %45, align 4
  %218 = load float, ptr %46, align 8
  %219 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull readonly align 8 dereferenceable(136) %0, ptr noundef nonnull %9, ptr noundef nonnull %10, float noundef %217, float noundef %218)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %9)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %10)
  br i1 %219, label %220, label %429

220:
  %221 = fadd contract <16 x float> %152, %214
  %222 = getelementptr inbounds <16 x float>, ptr %85, i64 %68
  store <16 x float> %221, ptr %222, align 4
  %223 = trunc i64 %150 to i32
  %224 = getelementptr inbounds i8, ptr %63, i64 8
  %225 = load ptr, ptr %224, align 8
  %226 = add nsw i64 %68, 1
  store i64 %226, ptr %67, align 8
  %227 = getelementptr inbounds i32, ptr %225, i64 %68
  store i32 %223, ptr %227, align 4
  %228 = getelementptr <16 x float>, ptr %85, i64 %226
  %229 = getelementptr i8, ptr %228, i64 -64
  %230 = load <16 x float>, ptr %229, align 4
  %231 = load ptr, ptr %66, align 8
  %232 = load ptr, ptr %41, align 8
  %233 = load <16 x float>, ptr %232, align 4
  %234 = fcmp contract oeq <16 x float> %233, zeroinitializer
  %235 = select contract <16 x i1> %234, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %236 = fadd contract <16 x float> %233, %235
  %237 = load ptr, ptr %42, align 8
  %238 = load <16 x float>, ptr %237, align 4
  %239 = icmp sgt i64 %73, 1
  br i1 %239, label %240, label %295

240:
  %241 = load <16 x float>, ptr %231, align 4
  %242 = fsub contract <16 x float> %230, %241
  %243 = fdiv contract <16 x float> %242, %236
  %244 = fadd contract <16 x float> %243, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %245 = fadd contract <16 x float> %244, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %246 = fmul contract <16 x float> %233, %245
  %247 = fsub contract <16 x float> %242, %246
  %248 = fmul contract <16 x float> %238, %247
  %249 = fmul contract <16 x float> %248, %248
  %250 = shufflevector <16 x float> %249, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %251 = shufflevector <16 x float> %249, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %252 = fadd contract <8 x float> %250, %251
  %253 = shufflevector <8 x float> %252, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %254 = shufflevector <8 x float> %252, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %255 = fadd contract <4 x float> %253, %254
  %256 = shufflevector <4 x float> %255, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %257 = fadd contract <4 x float> %255, %256
  %258 = shufflevector <4 x float> %255, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %259 = fadd contract <4 x float> %255, %258
  %260 = shufflevector <4 x float> %259, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %261 = fadd contract <4 x float> %257, %260
  %262 = extractelement <4 x float> %261, i64 0
  br label %263

263:
  %264 = phi i64 [ %292, %263 ], [ 0, %240 ]
  %265 = phi i64 [ %293, %263 ], [ 1, %240 ]
  %266 = phi float [ %291, %263 ], [ %262, %240 ]
  %267 = getelementptr inbounds <16 x float>, ptr %231, i64 %265
  %268 = load <16 x float>, ptr %267, align 4
  %269 = fsub contract <16 x float> %230, %268
  %270 = fdiv contract <16 x float> %269, %236
  %271 = fadd contract <16 x float> %270, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %272 = fadd contract <16 x float> %271, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %273 = fmul contract <16 x float> %233, %272
  %274 = fsub contract <16 x float> %269, %273
  %275 = fmul contract <16 x float> %238, %274
  %276 = fmul contract <16 x float> %275, %275
  %277 = shufflevector <16 x float> %276, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %278 = shufflevector <16 x float> %276, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %279 = fadd contract <8 x float> %277, %278
  %280 = shufflevector <8 x float> %279, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %281 = shufflevector <8 x float> %279, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %282 = fadd contract <4 x float> %280, %281
  %283 = shufflevector <4 x float> %282, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %284 = fadd contract <4 x float> %282, %283
  %285 = shufflevector <4 x float> %282, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %286 = fadd contract <4 x float> %282, %285
  %287 = shufflevector <4 x float> %286, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %288 = fadd contract <4 x float> %284, %287
  %289 = extractelement <4 x float> %288, i64 0
  %290 = fcmp contract olt float %289, %266
  %291 = select i1 %290, float %289, float %266
  %292 = select i1 %290, i64 %265, i64 %264
  %293 = add nuw nsw i64 %265, 1
  %294 = icmp eq i64 %293, %73
  br i1 %294, label %295, label %263

295:
  %296 = phi i64 [ 0, %220 ], [ %292, %263 ]
  %297 = getelementptr inbounds i8, ptr %66, i64 8
  br label %298

298:
  %299 = phi i64 [ %73, %295 ], [ %425, %424 ]
  %300 = phi i64 [ %296, %295 ], [ %426, %424 ]
  %301 = getelementptr inbounds <16 x float>, ptr %231, i64 %300
  %302 = load <16 x float>, ptr %301, align 4
  %303 = fsub contract <16 x float> %230, %302
  %304 = load ptr, ptr %41, align 8
  %305 = load <16 x float>, ptr %304, align 4
  %306 = fcmp contract oeq <16 x float> %305, zeroinitializer
  %307 = select contract <16 x i1> %306, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %308 = fadd contract <16 x float> %305, %307
  %309 = fdiv contract <16 x float> %303, %308
  %310 = fadd contract <16 x float> %309, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %311 = fadd contract <16 x float> %310, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %312 = fmul contract <16 x float> %305, %311
  %313 = fsub contract <16 x float> %303, %312
  %314 = load i64, ptr %43, align 8
  %315 = icmp eq i64 %314, 0
  %316 = load ptr, ptr %42, align 8
  %317 = load <16 x float>, ptr %316, align 4
  %318 = fmul contract <16 x float> %317, %313
  br i1 %315, label %319, label %335

319:
  %320 = fmul contract <16 x float> %318, %318
  %321 = shufflevector <16 x float> %320, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %322 = shufflevector <16 x float> %320, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %323 = fadd contract <8 x float> %321, %322
  %324 = shufflevector <8 x float> %323, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %325 = shufflevector <8 x float> %323, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %326 = fadd contract <4 x float> %324, %325
  %327 = shufflevector <4 x float> %326, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %328 = fadd contract <4 x float> %326, %327
  %329 = shufflevector <4 x float> %326, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %330 = fadd contract <4 x float> %326, %329
  %331 = shufflevector <4 x float> %330, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %332 = fadd contract <4 x float> %328, %331
  %333 = extractelement <4 x float> %332, i64 0
  %334 = tail call contract float @llvm.sqrt.f32(float %333)
  br label %338

335:
  %336 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %318)
  %337 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %336)
  br label %338

338:
  %339 = phi float [ %337, %335 ], [ %334, %319 ]
  %340 = load float, ptr %44, align 8
  %341 = fcmp contract ugt float %339, %340
  br i1 %341, label %342, label %347

342:
  %343 = fdiv contract float %340, %339
  %344 = insertelement <16 x float> poison, float %343, i64 0
  %345 = shufflevector <16 x float> %344, <16 x float> poison, <16 x i32> zeroinitializer
  %346 = fmul contract <16 x float> %313, %345
  br label %347

347:
  %348 = phi <16 x float> [ %313, %338 ], [ %346, %342 ]
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %12)
  store <16 x float> %302, ptr %11, align 64
  store <16 x float> %348, ptr %12, align 64
  %349 = load float, ptr %45, align 4
  %350 = load float, ptr %46, align 8
  %351 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull readonly align 8 dereferenceable(136) %0, ptr noundef nonnull %11, ptr noundef nonnull %12, float noundef %349, float noundef %350)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %12)
  br i1 %351, label %352, label %427

352:
  br i1 %341, label %414, label %353

353:
  %354 = select i1 %61, i64 %300, i64 %68
  %355 = select i1 %61, i64 %68, i64 %300
  %356 = icmp slt i64 %354, 0
  br i1 %356, label %375, label %362

357:
  %358 = lshr i64 %369, 1
  %359 = icmp eq i64 %364, 0
  br i1 %359, label %375, label %360

360:
  %361 = getelementptr <16 x float>, ptr %6, i64 %369
  br label %378

362:
  %363 = phi i64 [ %373, %366 ], [ %354, %353 ]
  %364 = phi i64 [ %369, %366 ], [ 0, %353 ]
  %365 = icmp eq i64 %364, 256
  br i1 %365, label %433, label %366

366:
  %367 = getelementptr inbounds <16 x float>, ptr %17, i64 %363
  %368 = load <16 x float>, ptr %367, align 4
  %369 = add nuw nsw i64 %364, 1
  %370 = getelementptr inbounds <16 x float>, ptr %6, i64 %364
  store <16 x float> %368, ptr %370, align 4
  %371 = getelementptr inbounds i32, ptr %20, i64 %363
  %372 = load i32, ptr %371, align 4
  %373 = zext nneg i32 %372 to i64
  %374 = icmp slt i32 %372, 0
  br i1 %374, label %357, label %362

375:
  %376 = phi i64 [ 1, %357 ], [ 0, %353 ], [ %369, %378 ]
  %377 = icmp slt i64 %355, 0
  br i1 %377, label %435, label %387

378:
  %379 = phi i64 [ 0, %360 ], [ %385, %378 ]
  %380 = xor i64 %379, -1
  %381 = getelementptr <16 x float>, ptr %361, i64 %380
  %382 = load <16 x float>, ptr %381, align 4
  %383 = getelementptr inbounds <16 x float>, ptr %6, i64 %379
  %384 = load <16 x float>, ptr %383, align 4
  store <16 x float> %384, ptr %381, align 4
  store <16 x float> %382, ptr %383, align 4
  %385 = add nuw nsw i64 %379, 1
  %386 = icmp eq i64 %385, %358
  br i1 %386, label %375, label %378

387:
  %388 = phi i64 [ %412, %391 ], [ %355, %375 ]
  %389 = phi i64 [ %409, %391 ], [ %376, %375 ]
  store i64 %388, ptr %7, align 8
  %390 = icmp eq i64 %389, 256
  br i1 %390, label %424, label %391

391:
  %392 = getelementptr <16 x float>, ptr %6, i64 %389
  %393 = getelementptr i8, ptr %392, i64 -64
  %394 = load <16 x float>, ptr %393, align 4
  %395 = getelementptr inbounds <16 x float>, ptr %25, i64 %388
  %396 = load <16 x float>, ptr %395, align 4
  %397 = fsub contract <16 x float> %396, %394
  %398 = load ptr, ptr %41, align 8
  %399 = load <16 x float>, ptr %398, align 4
  %400 = fcmp contract oeq <16 x float> %399, zeroinitializer
  %401 = select contract <16 x i1> %400, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %402 = fadd contract <16 x float> %399, %401
  %403 = fdiv contract <16 x float> %397, %402
  %404 = fadd contract <16 x float> %403, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %405 = fadd contract <16 x float> %404, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %406 = fmul contract <16 x float> %399, %405
  %407 = fsub contract <16 x float> %397, %406
  %408 = fadd contract <16 x float> %394, %407
  store <16 x float> %408, ptr %392, align 4
  %409 = add nuw nsw i64 %389, 1
  %410 = getelementptr inbounds i32, ptr %27, i64 %388
  %411 = load i32, ptr %410, align 4
  %412 = zext nneg i32 %411 to i64
  %413 = icmp slt i32 %411, 0
  br i1 %413, label %435, label %387

414:
  %415 = load i64, ptr %23, align 8
  %416 = icmp slt i64 %299, %415
  br i1 %416, label %417, label %427

417:
  %418 = fadd contract <16 x float> %302, %348
  %419 = getelementptr inbounds <16 x float>, ptr %231, i64 %299
  store <16 x float> %418, ptr %419, align 4
  %420 = trunc i64 %300 to i32
  %421 = load ptr, ptr %297, align 8
  %422 = add nsw i64 %299, 1
  store i64 %422, ptr %72, align 8
  %423 = getelementptr inbounds i32, ptr %421, i64 %299
  store i32 %420, ptr %423, align 4
  br label %424

424:
  %425 = phi i64 [ %422, %417 ], [ %299, %387 ]
  %426 = phi i64 [ %299, %417 ], [ %300, %387 ]
  br i1 %341, label %298, label %433

427:
  %428 = load i64, ptr %37, align 8
  br label %429

429:
  %430 = phi i64 [ %428, %427 ], [ %56, %216 ], [ %56, %213 ]
  %431 = add nuw nsw i64 %58, 1
  %432 = icmp slt i64 %431, %430
  br i1 %432, label %55, label %433

433:
  %434 = phi i64 [ 0, %31 ], [ -1, %362 ], [ -1, %424 ], [ 0, %429 ], [ 0, %71 ], [ 0, %55 ]
  call void @llvm.lifetime.end.p0(i64 48, ptr nonnull %13)
  br label %440

435:
  %436 = phi i64 [ %409, %391 ], [ %376, %375 ]
  store i64 %83, ptr %14, align 8
  call void @llvm.lifetime.end.p0(i64 48, ptr nonnull %13)
  %437 = icmp sgt i64 %436, 2
  br i1 %437, label %438, label %440

438:
  %439 = call fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull align 8 dereferenceable(96) %1, ptr noundef nonnull align 8 dereferenceable(8) %14, ptr noundef %6, i64 noundef %436)
  br label %440

440:
  %441 = phi i64 [ %439, %438 ], [ %436, %435 ], [ %434, %433 ]
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %14)
  ret i64 %441
}

define internal fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr nocapture noundef nonnull readonly align 8 dereferenceable(136) %0, ptr nocapture noundef nonnull readonly align 8 dereferenceable(96) %1, ptr nocapture noundef nonnull align 8 dereferenceable(8) %2, ptr nocapture noundef %3, i64 noundef %4) unnamed_addr {
  %6 = alloca <16 x float>, align 64
  %7 = alloca <16 x float>, align 64
  %8 = alloca <16 x float>, align 64
  %9 = alloca <16 x float>, align 64
  %10 = alloca [256 x float], align 16
  %11 = alloca float, align 4
  %12 = alloca float, align 4
  %13 = alloca i64, align 16
  %14 = alloca i64, align 8
  %15 = alloca <16 x float>, align 64
  %16 = alloca <16 x float>, align 64
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %10)
  %17 = icmp sgt i64 %4, 2
  br i1 %17, label %18, label %268

18:
  %19 = getelementptr inbounds i8, ptr %1, i64 84
  %20 = getelementptr inbounds i8, ptr %1, i64 88
  br label %21

21:
  %22 = phi i64 [ %4, %18 ], [ %66, %65 ]
  %23 = phi i64 [ 0, %18 ], [ %24, %65 ]
  %24 = add nuw nsw i64 %23, 1
  %25 = getelementptr inbounds <16 x float>, ptr %3, i64 %23
  %26 = load float, ptr %19, align 4
  %27 = load float, ptr %20, align 8
  br label %39

28:
  %29 = getelementptr inbounds i8, ptr %1, i64 56
  %30 = icmp sgt i64 %66, 2
  %31 = load i64, ptr %29, align 8
  %32 = icmp sgt i64 %31, 0
  %33 = select i1 %30, i1 %32, i1 false
  br i1 %33, label %34, label %268

34:
  %35 = getelementptr inbounds i8, ptr %1, i64 32
  %36 = getelementptr inbounds i8, ptr %1, i64 16
  %37 = getelementptr inbounds i8, ptr %1, i64 84
  %38 = getelementptr inbounds i8, ptr %1, i64 88
  br label %69

39:
  %40 = phi i64 [ %41, %43 ], [ %22, %21 ]
  %41 = add nsw i64 %40, -1
  %42 = icmp sgt i64 %41, %24
  br i1 %42, label %43, label %65

43:
  %44 = load <16 x float>, ptr %25, align 4
  %45 = getelementptr inbounds <16 x float>, ptr %3, i64 %41
  %46 = load <16 x float>, ptr %45, align 4
  %47 = fsub contract <16 x float> %46, %44
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %6)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %7)
  store <16 x float> %44, ptr %6, align 64
  store <16 x float> %47, ptr %7, align 64
  %48 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull %6, ptr noundef nonnull %7, float noundef %26, float noundef %27)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %6)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %7)
  br i1 %48, label %49, label %39

49:
  %50 = sub i64 1, %40
  %51 = icmp sgt i64 %40, %22
  br i1 %51, label %55, label %52

52:
  %53 = getelementptr <16 x float>, ptr %3, i64 %50
  %54 = getelementptr <16 x float>, ptr %53, i64 %24
  br label %58

55:
  %56 = add i64 %22, %24
  %57 = add i64 %56, %50
  br label %65

58:
  %59 = phi i64 [ %41, %52 ], [ %63, %58 ]
  %60 = getelementptr inbounds <16 x float>, ptr %3, i64 %59
  %61 = load <16 x float>, ptr %60, align 4
  %62 = getelementptr <16 x float>, ptr %54, i64 %59
  store <16 x float> %61, ptr %62, align 4
  %63 = add nsw i64 %59, 1
  %64 = icmp eq i64 %63, %22
  br i1 %64, label %55, label %58

65:
  %66 = phi i64 [ %57, %55 ], [ %22, %39 ]
  %67 = add nuw nsw i64 %23, 3
  %68 = icmp slt i64 %67, %66
  br i1 %68, label %21, label %28

69:
  %70 = phi i64 [ %66, %34 ], [ %263, %261 ]
  %71 = phi i64 [ 0, %34 ], [ %262, %261 ]
  store float 0.000000e+00, ptr %10, align 16
  %72 = load i64, ptr %35, align 8
  %73 = icmp eq i64 %72, 0
  %74 = load ptr, ptr %36, align 8
  %75 = load <16 x float>, ptr %3, align 4
  %76 = load <16 x float>, ptr %74, align 4
  br label %105

77:
  %78 = add nsw i64 %70, -1
  %79 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %78
  %80 = load float, ptr %79, align 4
  call void @llvm.lifetime.start.p0(i64 4, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 4, ptr nonnull %12)
  %81 = load i64, ptr %2, align 8
  %82 = add i64 %81, -7046029254386353131
  %83 = lshr i64 %82, 30
  %84 = xor i64 %83, %82
  %85 = mul i64 %84, -4658895280553007687
  %86 = lshr i64 %85, 27
  %87 = xor i64 %86, %85
  %88 = mul i64 %87, -7723592293110705685
  %89 = lshr i64 %88, 40
  %90 = uitofp nneg i64 %89 to float
  %91 = fmul contract float %90, 0x3E70000000000000
  %92 = fmul contract float %80, %91
  store float %92, ptr %11, align 4
  %93 = add i64 %81, 4354685564936845354
  store i64 %93, ptr %2, align 8
  %94 = lshr i64 %93, 30
  %95 = xor i64 %94, %93
  %96 = mul i64 %95, -4658895280553007687
  %97 = lshr i64 %96, 27
  %98 = xor i64 %97, %96
  %99 = mul i64 %98, -7723592293110705685
  %100 = lshr i64 %99, 40
  %101 = uitofp nneg i64 %100 to float
  %102 = fmul contract float %101, 0x3E70000000000000
  %103 = fmul contract float %80, %102
  store float %103, ptr %12, align 4
  %104 = fcmp contract ogt float %92, %103
  br i1 %104, label %138, label %139

105:
  %106 = phi <16 x float> [ %75, %69 ], [ %110, %132 ]
  %107 = phi float [ 0.000000e+00, %69 ], [ %134, %132 ]
  %108 = phi i64 [ 1, %69 ], [ %136, %132 ]
  %109 = getelementptr inbounds <16 x float>, ptr %3, i64 %108
  %110 = load <16 x float>, ptr %109, align 4
  %111 = fsub contract <16 x float> %110, %106
  %112 = fmul contract <16 x float> %111, %76
  br i1 %73, label %113, label %129

113:
  %114 = fmul contract <16 x float> %112, %112
  %115 = shufflevector <16 x float> %114, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %116 = shufflevector <16 x float> %114, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %117 = fadd contract <8 x float> %115, %116
  %118 = shufflevector <8 x float> %117, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %119 = shufflevector <8 x float> %117, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %120 = fadd contract <4 x float> %118, %119
  %121 = shufflevector <4 x float> %120, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %122 = fadd contract <4 x float> %120, %121
  %123 = shufflevector <4 x float> %120, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %124 = fadd contract <4 x float> %120, %123
  %125 = shufflevector <4 x float> %124, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %126 = fadd contract <4 x float> %122, %125
  %127 = extractelement <4 x float> %126, i64 0
  %128 = tail call contract float @llvm.sqrt.f32(float %127)
  br label %132

129:
  %130 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %112)
  %131 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %130)
  br label %132

132:
  %133 = phi float [ %131, %129 ], [ %128, %113 ]
  %134 = fadd contract float %107, %133
  %135 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %108
  store float %134, ptr %135, align 4
  %136 = add nuw nsw i64 %108, 1
  %137 = icmp eq i64 %136, %70
  br i1 %137, label %77, label %105

138:
  store float %103, ptr %11, align 4
  store float %92, ptr %12, align 4
  br label %139

139:
  %140 = phi float [ %103, %138 ], [ %92, %77 ]
  %141 = phi float [ %92, %138 ], [ %103, %77 ]
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %13)
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %14)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %15)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %16)
  %142 = add nsw i64 %70, -2
  %143 = add nsw i64 %70, -1
  %144 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %143
  br label %145

145:
  %146 = phi i1 [ true, %139 ], [ false, %213 ]
  %147 = phi ptr [ %15, %139 ], [ %16, %213 ]
  %148 = phi ptr [ %13, %139 ], [ %14, %213 ]
  %149 = phi ptr [ %11, %139 ], [ %12, %213 ]
  br label %190

150:
  %151 = fsub contract float %141, %140
  %152 = load <16 x float>, ptr %16, align 64
  %153 = load <16 x float>, ptr %15, align 64
  %154 = fsub contract <16 x float> %152, %153
  %155 = load i64, ptr %35, align 8
  %156 = icmp eq i64 %155, 0
  %157 = load ptr, ptr %36, align 8
  %158 = load <16 x float>, ptr %157, align 4
  %159 = fmul contract <16 x float> %154, %158
  br i1 %156, label %160, label %176

160:
  %161 = fmul contract <16 x float> %159, %159
  %162 = shufflevector <16 x float> %161, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %163 = shufflevector <16 x float> %161, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %164 = fadd contract <8 x float> %162, %163
  %165 = shufflevector <8 x float> %164, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %166 = shufflevector <8 x float> %164, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %167 = fadd contract <4 x float> %165, %166
  %168 = shufflevector <4 x float> %167, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %169 = fadd contract <4 x float> %167, %168
  %170 = shufflevector <4 x float> %167, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %171 = fadd contract <4 x float> %167, %170
  %172 = shufflevector <4 x float> %171, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %173 = fadd contract <4 x float> %169, %172
  %174 = extractelement <4 x float> %173, i64 0
  %175 = tail call contract float @llvm.sqrt.f32(float %174)
  br label %179

176:
  %177 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %159)
  %178 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %177)
  br label %179

179:
  %180 = phi float [ %178, %176 ], [ %175, %160 ]
  %181 = fsub contract float %151, %180
  %182 = load i64, ptr %13, align 16
  %183 = load i64, ptr %14, align 8
  %184 = icmp eq i64 %182, %183
  %185 = fmul contract float %80, 0x3F1A36E2E0000000
  %186 = fcmp contract olt float %181, %185
  %187 = select i1 %184, i1 true, i1 %186
  %188 = icmp sgt i64 %70, 254
  %189 = or i1 %188, %187
  br i1 %189, label %228, label %224

190:
  %191 = phi i64 [ %196, %195 ], [ 0, %145 ]
  %192 = icmp eq i64 %191, %142
  br i1 %192, label %193, label %195

193:
  %194 = load float, ptr %144, align 4
  br label %201

195:
  %196 = add nuw nsw i64 %191, 1
  %197 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %196
  %198 = load float, ptr %197, align 4
  %199 = load float, ptr %149, align 4
  %200 = fcmp contract olt float %198, %199
  br i1 %200, label %190, label %201

201:
  %202 = phi float [ %194, %193 ], [ %198, %195 ]
  %203 = phi i64 [ %143, %193 ], [ %196, %195 ]
  %204 = phi i64 [ %142, %193 ], [ %191, %195 ]
  %205 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %204
  %206 = load float, ptr %205, align 4
  %207 = fsub contract float %202, %206
  %208 = fcmp contract ogt float %207, 0.000000e+00
  br i1 %208, label %209, label %213

209:
  %210 = load float, ptr %149, align 4
  %211 = fsub contract float %210, %206
  %212 = fdiv contract float %211, %207
  br label %213

213:
  %214 = phi contract float [ %212, %209 ], [ 0.000000e+00, %201 ]
  %215 = getelementptr inbounds <16 x float>, ptr %3, i64 %204
  %216 = load <16 x float>, ptr %215, align 4
  %217 = insertelement <16 x float> poison, float %214, i64 0
  %218 = shufflevector <16 x float> %217, <16 x float> poison, <16 x i32> zeroinitializer
  %219 = getelementptr inbounds <16 x float>, ptr %3, i64 %203
  %220 = load <16 x float>, ptr %219, align 4
  %221 = fsub contract <16 x float> %220, %216
  %222 = fmul contract <16 x float> %218, %221
  %223 = fadd contract <16 x float> %216, %222
  store <16 x float> %223, ptr %147, align 64
  store i64 %204, ptr %148, align 8
  br i1 %146, label %145, label %150

224:
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %8)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %9)
  store <16 x float> %153, ptr %8, align 64
  store <16 x float> %154, ptr %9, align 64
  %225 = load float, ptr %37, align 4
  %226 = load float, ptr %38, align 8
  %227 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull %8, ptr noundef nonnull %9, float noundef %225, float noundef %226)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %8)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %9)
  br i1 %227, label %230, label %228

228:
  %229 = add nsw i64 %71, 1
  br label %261

230:
  %231 = fmul contract float %80, 0x3F847AE140000000
  %232 = fcmp contract ogt float %181, %231
  %233 = select i1 %232, i64 0, i64 %71
  %234 = sub i64 %182, %183
  %235 = add i64 %234, 2
  %236 = icmp sgt i64 %235, 0
  br i1 %236, label %240, label %237

237:
  %238 = add nsw i64 %183, 1
  %239 = icmp slt i64 %238, %70
  br i1 %239, label %249, label %256

240:
  %241 = icmp sgt i64 %78, %183
  br i1 %241, label %242, label %256

242:
  %243 = phi i64 [ %247, %242 ], [ %78, %240 ]
  %244 = getelementptr inbounds <16 x float>, ptr %3, i64 %243
  %245 = load <16 x float>, ptr %244, align 4
  %246 = getelementptr <16 x float>, ptr %244, i64 %235
  store <16 x float> %245, ptr %246, align 4
  %247 = add nsw i64 %243, -1
  %248 = icmp sgt i64 %247, %183
  br i1 %248, label %242, label %256

249:
  %250 = phi i64 [ %254, %249 ], [ %238, %237 ]
  %251 = getelementptr inbounds <16 x float>, ptr %3, i64 %250
  %252 = load <16 x float>, ptr %251, align 4
  %253 = getelementptr <16 x float>, ptr %251, i64 %235
  store <16 x float> %252, ptr %253, align 4
  %254 = add nsw i64 %250, 1
  %255 = icmp eq i64 %254, %70
  br i1 %255, label %256, label %249

256:
  %257 = getelementptr <16 x float>, ptr %3, i64 %182
  %258 = getelementptr i8, ptr %257, i64 64
  store <16 x float> %153, ptr %258, align 4
  %259 = getelementptr i8, ptr %257, i64 128
  store <16 x float> %152, ptr %259, align 4
  %260 = add nsw i64 %235, %70
  br label %261

261:
  %262 = phi i64 [ %229, %228 ], [ %233, %256 ]
  %263 = phi i64 [ %70, %228 ], [ %260, %256 ]
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %15)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %16)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %13)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %14)
  call void @llvm.lifetime.end.p0(i64 4, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 4, ptr nonnull %12)
  %264 = icmp sgt i64 %263, 2
  %265 = load i64, ptr %29, align 8
  %266 = icmp slt i64 %262, %265
  %267 = select i1 %264, i1 %266, i1 false
  br i1 %267, label %69, label %268

268:
  %269 = phi i64 [ %66, %28 ], [ %4, %5 ], [ %263, %261 ]
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %10)
  ret i64 %269
}

define noundef i64 @shorten(ptr nocapture noundef nonnull readonly %0, ptr nocapture noundef nonnull readonly %1, ptr nocapture noundef %2, i64 noundef %3, i64 noundef %4) {
  %6 = alloca %struct.Random, align 8
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %6)
  store i64 %4, ptr %6, align 8
  %7 = call fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull align 8 dereferenceable(96) %1, ptr noundef nonnull align 8 dereferenceable(8) %6, ptr noundef %2, i64 noundef %3)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %6)
  ret i64 %7
}

declare void @llvm.memset.p0.i64(ptr nocapture writeonly, i8, i64, i1 immarg)

declare <16 x float> @llvm.fabs.v16f32(<16 x float>)

declare void @llvm.memcpy.p0.p0.i64(ptr noalias nocapture writeonly, ptr noalias nocapture readonly, i64, i1 immarg)

declare <16 x float> @llvm.sqrt.v16f32(<16 x float>)

declare <8 x double> @llvm.fabs.v8f64(<8 x double>)

declare <8 x double> @llvm.sqrt.v8f64(<8 x double>)

declare float @llvm.sqrt.f32(float)

declare float @llvm.vector.reduce.fmax.v16f32(<16 x float>)

declare i64 @llvm.smin.i64(i64, i64)



